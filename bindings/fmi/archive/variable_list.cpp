#include "bindings/fmi/archive/variable_list.hpp"

#include <cmath>

#include <fmt/format.h>

#include "bindings/fmi/plant_parameters.hpp"
#include "bindings/fmi/variables.hpp"

namespace wormdrive {
namespace {

constexpr unsigned ref(ScalarVariable v) { return static_cast<unsigned>(v); }

class VariableLister {
 public:
  explicit VariableLister(const FmuModel& model)
      : model_(model),
        scenario_(model.scenario),
        elastic_(has_elastic_teeth(scenario_.effects)),
        ports_(scenario_.effects) {}

  std::vector<VariableInfo> list() {
    using enum ScalarVariable;
    list_.push_back({"time", ref(time), "independent", "continuous", "time", false, "s"});
    if (elastic_) shaft("worm", worm_angle, worm_speed, worm_angle_rate, worm_speed_rate);
    shaft("gear", gear_angle, gear_speed, gear_angle_rate, gear_speed_rate);
    scenario_.effects.for_each_state(
        [&](std::string_view id, const EffectState& state, std::size_t place) { of_effect(id, state, place); });
    torque();
    if (scenario_.control) {
      VariableInfo& sampled = real("controller_torque", ref(controller_torque), "output", "N m",
                                   "motor torque that the controller commands from its latest sample on");
      sampled.variability = "discrete";
      sampled.sampled = true;
    }
    real("normal_force", ref(normal_force), "output", "N", "normal force between the teeth");
    real("measured_angle", ref(measured_angle), "output", "rad", "gear angle as the sensor measures it").depends_on = {
        {"gear_angle"}};
    if (scenario_.control && !scenario_.control->reference.terms.empty()) {
      real("reference_angle", ref(reference_angle), "output", "rad", "gear angle that the controller follows")
          .depends_on.emplace();
      real("reference_speed", ref(reference_speed), "output", "rad/s", "its rate").depends_on.emplace();
    }
    whole("motion", motion, "-1 backward, 0 stuck, 1 forward; of elastic teeth the worm", -1.0, 1.0);
    whole("flank", flank, "flank that carries: -1 right, 0 none, 1 left", -1.0, 1.0);
    if (elastic_) whole("gear_motion", gear_motion, "-1 backward, 0 stuck, 1 forward", -1.0, 1.0);
    whole("event_count", event_count, "changes of motion or flank since the start", 0.0);
    real("event_time", ref(event_time), "output", "s", "when the latest of them was").variability = "discrete";
    if (offered(model_).model_exchange) indicators();
    parameters();
    return std::move(list_);
  }

 private:
  /// A value that the model calculates.
  VariableInfo& real(const std::string& name, unsigned reference, const std::string& causality,
                     const std::string& rotary_unit, const std::string& description) {
    const bool acceleration = rotary_unit == "rad/s^2" && scenario_.axis == Axis::linear;
    const std::string unit = acceleration ? "m/s^2" : rotary_unit.empty() ? "" : units_on(scenario_.axis, rotary_unit);
    list_.push_back({name, reference, causality, "continuous", in_words_of(scenario_.axis, description), false, unit});
    return list_.back();
  }
  void whole(const std::string& name, ScalarVariable reference, const std::string& description, double min,
             std::optional<double> max = {}) {
    list_.push_back({name, ref(reference), "output", "discrete", description, true, "", {}, min, max});
  }
  void shaft(const std::string& name, ScalarVariable angle, ScalarVariable speed, ScalarVariable angle_rate,
             ScalarVariable speed_rate) {
    real(name + "_angle", ref(angle), "output", "rad", name + " angle").depends_on = {{name + "_angle"}};
    real(name + "_speed", ref(speed), "output", "rad/s", name + " speed; exactly 0 while stuck").depends_on = {
        {name + "_speed"}};
    VariableInfo& rate =
        real("der(" + name + "_angle)", ref(angle_rate), "local", "rad/s", "rate of the " + name + " angle");
    rate.derivative_of = name + "_angle";
    rate.depends_on = {{name + "_speed"}};
    real("der(" + name + "_speed)", ref(speed_rate), "local", "rad/s^2", "acceleration of the " + name).derivative_of =
        name + "_speed";
  }
  void of_effect(std::string_view id, const EffectState& state, std::size_t place) {
    const std::string name = fmt::format("effect.{}.{}", id, state.name), unit(state.unit.symbol);
    const auto reference = [place](unsigned first) { return first + static_cast<unsigned>(place); };
    real(name, reference(first_effect_state), "output", unit, fmt::format("{} of effect.{}", state.name, id))
        .depends_on = {{name}};
    const std::string rate_unit = unit + (unit.ends_with("/s") ? "^2" : "/s");
    real("der(" + name + ")", reference(first_effect_rate), "local", rate_unit, "rate of " + name).derivative_of = name;
  }
  void torque() {
    const unsigned reference = ref(ScalarVariable::motor_torque);
    if (model_.kind == FmuKind::loop)
      real("motor_torque", reference, "output", "N m", "motor torque behind the effects of the actuator");
    else
      real("motor_torque", reference, "input", "N m", "motor torque before the effects of the actuator").start = 0.0;
  }
  void indicators() {
    for (unsigned k = 0; k < ports_.indicators.size(); ++k) {
      std::string name = "indicator." + std::string(ports_.indicators[k]);
      for (char& c : name)
        if (c == ' ' || c == '-') c = '_';
      real(name, first_indicator + k, "local", "",
           fmt::format("event indicator {}: positive while the mode holds; 1 where the mode has none", k + 1));
    }
  }
  void parameters() {
    unsigned reference = first_parameter;
    for (const PlantParameter<const double>& parameter : plant_parameters(scenario_)) {
      VariableInfo one{parameter.name,
                       reference++,
                       "parameter",
                       "fixed",
                       in_words_of(scenario_.axis, parameter.meaning),
                       false,
                       std::string(parameter.unit.symbol),
                       *parameter.value};
      if (std::isfinite(parameter.bounds.low)) one.min = parameter.bounds.low;
      if (std::isfinite(parameter.bounds.high)) one.max = parameter.bounds.high;
      list_.push_back(one);
    }
  }

  const FmuModel& model_;
  const Scenario& scenario_;
  const bool elastic_;
  const InterfaceNames ports_;
  std::vector<VariableInfo> list_;
};

}  // namespace

std::vector<VariableInfo> variables_of(const FmuModel& model) { return VariableLister(model).list(); }

}  // namespace wormdrive
