// The variables of an instance: values, start values, and their derivatives.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "bindings/fmi/instance.hpp"
#include "bindings/fmi/plant_parameters.hpp"

namespace wormdrive {
namespace {

[[noreturn]] void unknown(unsigned reference) {
  throw std::invalid_argument(fmt::format("there is no variable with the value reference {}", reference));
}

/// The parameter of a value reference.
PlantParameter<double> parameter(Scenario& scenario, unsigned reference) {
  std::vector<PlantParameter<double>> all = plant_parameters(scenario);
  if (reference < first_parameter || reference - first_parameter >= all.size()) unknown(reference);
  return std::move(all[reference - first_parameter]);
}

constexpr auto motor_torque = static_cast<unsigned>(ScalarVariable::motor_torque);

}  // namespace

ReferencePoint FmuInstance::reference_point(unsigned reference) const {
  const auto& control = model_.scenario.control;
  if (!control || control->reference.terms.empty()) unknown(reference);
  return control->reference.at(state_.time);
}

/// A drive with states of effects has places for those of all effects.
void FmuInstance::reject_absent_state(unsigned reference) const {
  if (reference < first_effect_state || reference >= first_parameter) return;
  if (!ports().has_state(static_cast<ScalarVariable>(reference))) unknown(reference);
}

double FmuInstance::real(unsigned reference) {
  reject_absent_state(reference);
  if (reference >= first_parameter) return *parameter(model_.scenario, reference).value;
  const auto variable = static_cast<ScalarVariable>(reference);
  if (variable == ScalarVariable::time) return state_.time;
  if (variable == ScalarVariable::motor_torque && model_.kind == FmuKind::plant) return state_.torque;
  if (variable == ScalarVariable::reference_angle) return reference_point(reference).angle;
  if (variable == ScalarVariable::reference_speed) return reference_point(reference).speed;
  return with_run([&]<class Run>(Run& run) {
    using Ports = typename Run::Ports;
    const auto at = [&](const auto& list) {
      return static_cast<std::size_t>(std::find(list.begin(), list.end(), variable) - list.begin());
    };
    if (const std::size_t k = at(Ports::states); k < Ports::states.size()) return run.states()[k];
    if (const std::size_t k = at(Ports::rates); k < Ports::rates.size()) return run.rates()[k];
    if (reference >= first_indicator && reference < first_indicator + Run::indicator_count)
      return run.indicators()[reference - first_indicator];
    if (variable == ScalarVariable::motor_torque) return run.observe().tau_m;
    if (variable == ScalarVariable::normal_force) return run.observe().normal_force;
    if (variable == ScalarVariable::measured_angle) return run.measured_angle();
    if constexpr (!MovedFromOutside<Run>)
      if (variable == ScalarVariable::controller_torque && model_.scenario.control) return run.commanded();
    if (variable == ScalarVariable::event_time) return run.events().latest;
    unknown(reference);
  });
}

int FmuInstance::integer(unsigned reference) {
  return with_run([&](auto& run) {
    const auto variable = static_cast<ScalarVariable>(reference);
    if (variable == ScalarVariable::event_count) return run.events().count;
    const Observation at = run.observe();
    if (variable == ScalarVariable::motion) return sign(at.mode.motion);
    if (variable == ScalarVariable::flank) return sign(at.mode.flank);
    if (variable == ScalarVariable::gear_motion && at.teeth) return sign(at.teeth->gear);
    unknown(reference);
  });
}

void FmuInstance::reject_unsettable(unsigned reference, double value) {
  const bool is_torque = static_cast<ScalarVariable>(reference) == ScalarVariable::motor_torque;
  if (is_torque && model_.kind == FmuKind::plant) {
    if (!std::isfinite(value)) throw std::invalid_argument(fmt::format("motor_torque = {} must be finite", value));
    return;
  }
  const PlantParameter<double> set = parameter(model_.scenario, reference);
  if (!set.is_allowed(value))
    throw std::invalid_argument(fmt::format("{} = {} is not an allowed value", set.name, value));
  if (!before_run.contain(phase()))
    throw std::logic_error("parameters can be set before the end of the initialization mode only");
}

void FmuInstance::set_reals(std::span<const unsigned> references, std::span<const double> values) {
  for (std::size_t k = 0; k < references.size(); ++k) reject_unsettable(references[k], values[k]);
  for (std::size_t k = 0; k < references.size(); ++k) {
    if (references[k] >= first_parameter)
      *parameter(model_.scenario, references[k]).value = values[k];
    else
      state_.torque = values[k];
  }
  if (before_run.contain(phase()))
    stale_ = stale_ || phase() == Phase::initialization;
  else
    with_run([&](auto& run) { run.set_torque(state_.torque, phase() == Phase::event); });
}

void FmuInstance::set_integer(unsigned reference) {
  throw std::invalid_argument(fmt::format("no whole number can be set; value reference {}", reference));
}

double FmuInstance::output_rate(unsigned reference) {
  reject_absent_state(reference);
  const auto variable = static_cast<ScalarVariable>(reference);
  if (variable == ScalarVariable::reference_angle) return real(static_cast<unsigned>(ScalarVariable::reference_speed));
  if (variable == ScalarVariable::reference_speed) return reference_point(reference).acceleration;
  return with_run([&]<class Run>(Run& run) {
    const bool input = reference == motor_torque && model_.kind == FmuKind::plant;
    if constexpr (!MovedFromOutside<Run>) {
      const auto shown = run.along_motion();
      if (const auto* const value = input ? nullptr : shown.find(reference)) return value->v[0];
    }
    throw std::invalid_argument(
        fmt::format("value reference {} is no continuous output with a rate in co-simulation", reference));
    return 0.0;
  });
}

std::vector<double> FmuInstance::jacobian(std::span<const unsigned> unknowns, std::span<const unsigned> knowns) {
  std::vector<double> matrix;
  with_moved_run([&]<class Run>(Run& run) {
    const auto all = run.linearization();
    for (const unsigned known : knowns) reject_absent_state(known);
    for (const unsigned unknown : unknowns) {
      reject_absent_state(unknown);
      const auto* const value = unknown == motor_torque ? nullptr : all.find(unknown);
      if (!value)
        throw std::invalid_argument(fmt::format(
            "value reference {} is no continuous output, rate or event indicator to differentiate", unknown));
      for (const unsigned known : knowns) {
        const int k = derivative_by<typename Run::System>(known);
        if (k < 0)
          throw std::invalid_argument(
              fmt::format("value reference {} is no state and no input to differentiate by", known));
        matrix.push_back(value->v[k]);
      }
    }
  });
  return matrix;
}

}  // namespace wormdrive
