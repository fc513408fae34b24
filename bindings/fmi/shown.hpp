#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include <ceres/jet.h>

#include "bindings/fmi/indicators.hpp"

namespace wormdrive {

/// What an FMU shows of a drive in its present mode, in a scalar that may carry derivatives.
template <class Drive, class S>
struct Shown {
  using Ports = Interface<Drive>;
  std::array<S, Drive::state_size> states, rates;
  S motor_torque;  ///< behind the effects of the actuator
  S normal_force, measured_angle;
  std::array<S, Ports::indicators.size()> indicators;

  /// The value of a value reference; null where it is no continuous output, rate or event indicator.
  const S* find(unsigned reference) const {
    const auto variable = static_cast<ScalarVariable>(reference);
    for (std::size_t k = 0; k < states.size(); ++k) {
      if (variable == Ports::states[k]) return &states[k];
      if (variable == Ports::rates[k]) return &rates[k];
    }
    if (variable == ScalarVariable::motor_torque) return &motor_torque;
    if (variable == ScalarVariable::normal_force) return &normal_force;
    if (variable == ScalarVariable::measured_angle) return &measured_angle;
    if (reference >= first_indicator && reference < first_indicator + indicators.size())
      return &indicators[reference - first_indicator];
    return nullptr;
  }
};

/// The gear angle [rad] that an encoder on the gear's shaft or on the worm's shows.
template <class Drive, class M>
auto encoder_angle(const Drive& drive, const M& at, bool on_worm) {
  return drive.effects().measured_angle(on_worm ? at.theta_w / drive.mesh().i : at.theta_g);
}

/// A moment with the states of the effects that says what the motor is told [N m].
template <class S>
struct CommandedMomentOfEffects : MomentOfEffects<S> {
  S command;
};

/// At a time [s] with states, the motor told a torque [N m].
template <class S, class Load, bool with_states, std::size_t count>
auto commanded_moment(const WormDrive<double, Load, with_states>& drive, const S& t, const std::array<S, count>& x,
                      const S& told) {
  const Moment<S> at = drive.moment(t, x[0], x[1]);
  if constexpr (with_states) {
    CommandedMomentOfEffects<S> with{{at, {}}, told};
    std::copy(x.begin() + 2, x.end(), with.states.begin());
    return with;
  } else {
    return CommandedMoment<S>{at, told};
  }
}

/// At a time [s], with states and a motor that is told a torque [N m]; the mode is that of an instant.
template <class S, class Load, bool with_states, std::size_t count>
auto show(const WormDrive<double, Load, with_states>& drive,
          const Indicators<WormDrive<double, Load, with_states>>& indicators,
          const typename WormDrive<double, Load, with_states>::Instant& now, const S& t, const std::array<S, count>& x,
          const S& told, bool on_worm) {
  using Drive = WormDrive<double, Load, with_states>;
  const Mode mode = now.mode;
  auto at = commanded_moment(drive, t, x, told);
  const bool stuck = mode.motion == Motion::stuck;
  if (stuck) at.rest = t - now.since;
  const S acceleration = drive.acceleration(at, mode);
  std::array<S, count> rates{stuck ? S(0.0) : x[1], acceleration};
  if constexpr (with_states) {
    const auto of_effects = drive.state_rates(at, mode);
    std::copy(of_effects.begin(), of_effects.end(), rates.begin() + 2);
  }
  return Shown<Drive, S>{x,
                         rates,
                         drive.inputs(at, mode.motion).worm,
                         drive.normal_force(drive.side_torques(at, mode.motion), at, acceleration, mode),
                         encoder_angle(drive, at, on_worm),
                         indicators.all(drive.guards(at, mode), now)};
}
template <class S, class Load>
auto show(const CompliantDrive<double, Load>& drive, const Indicators<CompliantDrive<double, Load>>& indicators,
          const typename CompliantDrive<double, Load>::Instant& now, const S& t, const std::array<S, 4>& x,
          const S& told, bool on_worm) {
  const CompliantMode mode = now.mode;
  const CommandedMoment<S> at{drive.moment(t, x[0], x[1], x[2], x[3]), told};
  const auto a = drive.accelerations(at, mode);
  const auto rate = [](Motion motion, const S& speed) { return motion == Motion::stuck ? S(0.0) : speed; };
  return Shown<CompliantDrive<double, Load>, S>{x,
                                                {rate(mode.worm, x[1]), a.worm, rate(mode.gear, x[3]), a.gear},
                                                drive.rigid().inputs(at, mode.gear).worm,
                                                drive.normal_force(at, mode),
                                                encoder_angle(drive, at, on_worm),
                                                indicators.all(drive.guards(at, mode), now)};
}

/// The input of the motor, whatever the teeth.
template <class Load, bool with_states>
const MotorInput<double>& motor_of(const WormDrive<double, Load, with_states>& drive) {
  return drive.motor_input();
}
template <class Load>
const MotorInput<double>& motor_of(const CompliantDrive<double, Load>& drive) {
  return drive.rigid().motor_input();
}

/// Which derivative of a linearization is the one by a value reference; -1 where it is no state and not the motor
/// torque, which comes last.
template <class Drive>
int derivative_by(unsigned reference) {
  const auto variable = static_cast<ScalarVariable>(reference);
  if (variable == ScalarVariable::motor_torque) return Drive::state_size;
  const auto& states = Interface<Drive>::states;
  const auto at = std::find(states.begin(), states.end(), variable);
  return at == states.end() ? -1 : static_cast<int>(at - states.begin());
}

/// With the derivatives by the states in their order and by a torque [N m] that the motor is told. Beyond its limit
/// nothing follows from that. The encoder sits on the gear, for a controller outside.
template <class Drive>
auto linearize(const Drive& drive, const Indicators<Drive>& indicators, const typename Drive::Instant& now,
               double told) {
  constexpr int states = Drive::state_size;
  using Jet = ceres::Jet<double, states + 1>;
  std::array<Jet, states> x;
  for (int k = 0; k < states; ++k) x[k] = Jet(now.x[k], k);
  Jet given(motor_of(drive)(now.t));
  if (std::abs(told) <= drive.torque_limit()) given.v[states] = 1.0;
  return show(drive, indicators, now, Jet(now.t), x, given, false);
}

/// With the derivatives by time, along the motion.
template <class Drive>
auto along_motion(const Drive& drive, const Indicators<Drive>& indicators, const typename Drive::Instant& now,
                  bool on_worm) {
  using Jet = ceres::Jet<double, 1>;
  const auto rate = drive.derivative(now.t, now.x, now.mode);
  std::array<Jet, Drive::state_size> x;
  for (int k = 0; k < Drive::state_size; ++k) {
    x[k].a = now.x[k];
    x[k].v[0] = rate[k];
  }
  const Jet t(now.t, 0);
  return show(drive, indicators, now, t, x, motor_of(drive)(t), on_worm);
}

}  // namespace wormdrive
