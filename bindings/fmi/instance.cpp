#include "bindings/fmi/instance.hpp"

#include <stdexcept>

#include <fmt/format.h>

#include "bindings/fmi/plant_parameters.hpp"
#include "core/elastic/elastic_teeth.hpp"
#include "description/rejection.hpp"

namespace wormdrive {
namespace {

[[noreturn]] void unknown(unsigned reference) {
  throw std::invalid_argument(fmt::format("there is no variable with the value reference {}", reference));
}

}  // namespace

void FmuInstance::begin() {
  stale_ = false;
  state_.run.reset();
  if (const auto why = why_the_drive_cannot_run(set_)) throw std::invalid_argument(*why);
  if (const auto id = set_.effects.first_with_states(); !id.empty())
    throw std::invalid_argument(fmt::format("effect.{} has a state, which the FMU does not carry", id));
  with_drive(set_, [&]<class Drive>(Drive& drive) {
    using Elastic = decltype(CompliantDrive(drive, tooth_contact(set_.effects)));
    if (has_elastic_teeth(set_.effects))
      state_.run.emplace(PlantRun<Elastic>(CompliantDrive(drive, tooth_contact(set_.effects)), set_.initial,
                                           state_.time, state_.torque));
    else
      state_.run.emplace(PlantRun<Drive>(drive, set_.initial, state_.time, state_.torque));
  });
}

void FmuInstance::enter_initialization() {
  state_.phase = Phase::initialization;
  begin();
}

void FmuInstance::exit_initialization() {
  if (stale_) begin();
  state_.phase = Phase::event;
}

void FmuInstance::reset() {
  set_ = stated_;
  state_ = {};
  stale_ = false;
}

void FmuInstance::restore(const Kept& kept) {
  state_ = kept.state;
  set_ = kept.set;
  stale_ = false;
}

void FmuInstance::set_time(double t) {
  state_.time = t;
  with_run([&](auto& run) { run.set_time(t); });
}

double FmuInstance::parameter(unsigned k) const {
  std::optional<double> found;
  for_each_plant_parameter(set_, [&](const std::string&, const auto&, const double& value) {
    if (k-- == 0) found = value;
  });
  if (!found) unknown(first_parameter + k);
  return *found;
}

void FmuInstance::set_parameter(unsigned k, double value) {
  const unsigned reference = first_parameter + k;
  bool found = false;
  for_each_plant_parameter(set_, [&](const std::string& path, const auto& field, double& stated) {
    if (k-- != 0) return;
    found = true;
    if (!std::isfinite(value) || !field.bounds.contain(value))
      throw std::invalid_argument(
          fmt::format("{}.{} = {} is not an allowed value", path, si_spelling(field, set_.axis).key, value));
    stated = value;
  });
  if (!found) unknown(reference);
}

double FmuInstance::real(unsigned reference) {
  if (reference >= first_parameter) return parameter(reference - first_parameter);
  if (static_cast<ScalarVariable>(reference) == ScalarVariable::motor_torque) return state_.torque;
  return with_run([&]<class Run>(Run& run) {
    using Ports = typename Run::Ports;
    const auto at = [&](const auto& list) {
      return static_cast<std::size_t>(std::find(list.begin(), list.end(), static_cast<ScalarVariable>(reference)) -
                                      list.begin());
    };
    if (const std::size_t k = at(Ports::states); k < Ports::states.size()) {
      std::array<double, Run::state_size> x;
      run.state(x.data());
      return x[k];
    }
    if (const std::size_t k = at(Ports::rates); k < Ports::rates.size()) {
      std::array<double, Run::state_size> rate;
      run.rates(rate.data());
      return rate[k];
    }
    if (reference >= first_indicator && reference < first_indicator + Run::indicator_count) {
      std::array<double, Run::indicator_count> z;
      run.indicators(z.data());
      return z[reference - first_indicator];
    }
    if (static_cast<ScalarVariable>(reference) == ScalarVariable::normal_force) return run.observe().normal_force;
    if (static_cast<ScalarVariable>(reference) == ScalarVariable::measured_angle) return run.measured_angle();
    unknown(reference);
  });
}

int FmuInstance::integer(unsigned reference) {
  const Observation at = with_run([](auto& run) { return run.observe(); });
  if (static_cast<ScalarVariable>(reference) == ScalarVariable::motion) return sign(at.mode.motion);
  if (static_cast<ScalarVariable>(reference) == ScalarVariable::flank) return sign(at.mode.flank);
  if (static_cast<ScalarVariable>(reference) == ScalarVariable::gear_motion && at.teeth) return sign(at.teeth->gear);
  unknown(reference);
}

void FmuInstance::set_real(unsigned reference, double value) {
  const bool before = phase() == Phase::instantiated || phase() == Phase::initialization;
  if (static_cast<ScalarVariable>(reference) == ScalarVariable::motor_torque) {
    if (!std::isfinite(value)) throw std::invalid_argument(fmt::format("motor_torque = {} must be finite", value));
    state_.torque = value;
    stale_ = stale_ || phase() == Phase::initialization;
    if (!before) with_run([&](auto& run) { run.set_torque(value, phase() == Phase::event); });
    return;
  }
  if (reference < first_parameter) unknown(reference);
  if (!before) throw std::logic_error("parameters can be set before the end of the initialization mode only");
  set_parameter(reference - first_parameter, value);
  stale_ = stale_ || phase() == Phase::initialization;
}

void FmuInstance::set_integer(unsigned reference) {
  throw std::invalid_argument(fmt::format("no whole number can be set; value reference {}", reference));
}

}  // namespace wormdrive
