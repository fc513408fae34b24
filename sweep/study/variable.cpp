#include "sweep/study/variable.hpp"

#include <fmt/format.h>

namespace wormdrive {
namespace {

class Collector {
 public:
  explicit Collector(Axis axis) : axis_(axis) {}

  /// A table that has no list of fields, as one of samples, holds no single numbers.
  template <class Parameters>
  void table(const std::string& path, Parameters& parameters) {
    if constexpr (requires { Parameters::fields(); })
      for_each_field<Parameters>([&](const auto& field) {
        for (Spelling& spelling : spellings(field.name, field.unit, axis_)) {
          spelling.key = fmt::format("{}.{}", path, spelling.key);
          const std::string name = fmt::format("{}.{}", path, spelling.stem);
          list_.push_back({name, std::move(spelling), field.bounds, &(parameters.*field.member)});
        }
      });
  }
  /// The terms of a sum; a single one needs no index.
  template <class Sum>
  void terms(const std::string& path, Sum& sum) {
    for (std::size_t k = 0; k < sum.terms.size(); ++k)
      std::visit(
          [&](auto& term) {
            if (sum.terms.size() == 1) table(path, term);
            table(fmt::format("{}[{}]", path, k), term);
          },
          sum.terms[k]);
  }
  template <class Load>
  void load(Load& stated) {
    if constexpr (requires { stated.terms; }) {
      terms("load", stated);
    } else {
      table("load", stated);
      table("load[0]", stated);
    }
  }
  void control(ControlScenario& control) {
    table("controller", control.sampling);
    if (winds_up(control.law)) table("controller", control.anti_windup);
    std::visit(
        [&](auto& law) {
          if constexpr (requires { law.torque; })
            terms("controller.torque", law.torque);
          else
            table("controller", law);
        },
        control.law);
    table("controller.nominal", control.nominal);
    table("controller.variation", control.variations);
    terms("reference", control.reference);
    table("sensor", control.sensor);
    table("disturbance", control.disturbance);
  }
  std::vector<Variable> take() { return std::move(list_); }

 private:
  Axis axis_;
  std::vector<Variable> list_;
};

}  // namespace

std::vector<Variable> variables(Scenario& scenario) {
  Collector collector(scenario.axis);
  std::visit([&](auto& mesh) { collector.table("mesh", mesh); }, scenario.mesh);
  collector.terms("motor.torque", scenario.motor);
  std::visit([&](auto& load) { collector.load(load); }, scenario.load);
  scenario.effects.for_each([&](auto& effect) {
    if (effect) collector.table(fmt::format("effect.{}", effect->id), *effect);
  });
  collector.table("initial", scenario.initial);
  if (scenario.control) collector.control(*scenario.control);
  return collector.take();
}

}  // namespace wormdrive
