#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include <ceres/jet.h>

#include "bindings/fmi/indicators.hpp"

namespace wormdrive {

/// What an FMU shows of a drive, each value with its exact derivatives in the present mode: by the states in their
/// order, then by the motor torque.
template <class Drive>
struct Linearization {
  static constexpr int torque = Drive::state_size;  ///< index of the derivative by the motor torque
  using Jet = ceres::Jet<double, Drive::state_size + 1>;
  using Ports = Interface<Drive>;

  std::array<Jet, Drive::state_size> states, rates;
  Jet normal_force, measured_angle;
  std::array<Jet, Ports::indicators.size()> indicators;

  /// The value of a value reference; null where it is no continuous output, rate or event indicator.
  const Jet* unknown(unsigned reference) const {
    const auto variable = static_cast<ScalarVariable>(reference);
    for (std::size_t k = 0; k < states.size(); ++k) {
      if (variable == Ports::states[k]) return &states[k];
      if (variable == Ports::rates[k]) return &rates[k];
    }
    if (variable == ScalarVariable::normal_force) return &normal_force;
    if (variable == ScalarVariable::measured_angle) return &measured_angle;
    if (reference >= first_indicator && reference < first_indicator + indicators.size())
      return &indicators[reference - first_indicator];
    return nullptr;
  }
  /// Which derivative is the one by a value reference; -1 where it is no state and not the motor torque.
  static int known(unsigned reference) {
    const auto variable = static_cast<ScalarVariable>(reference);
    if (variable == ScalarVariable::motor_torque) return torque;
    const auto at = std::find(Ports::states.begin(), Ports::states.end(), variable);
    return at == Ports::states.end() ? -1 : static_cast<int>(at - Ports::states.begin());
  }
};

/// What the motor gives for a torque [N m] that it is told: nothing more beyond its limit.
template <class Jet, class Load>
Jet command(const WormDrive<double, Load>& drive, double t, double told) {
  Jet given(drive.motor_command(t));
  if (std::abs(told) <= drive.torque_limit()) given.v[given.v.size() - 1] = 1.0;
  return given;
}

/// The linearization at an instant, with the motor told a torque [N m].
template <class Load>
auto linearize(const WormDrive<double, Load>& drive, const Indicators<WormDrive<double, Load>>& indicators,
               const typename WormDrive<double, Load>::Instant& now, double told) {
  using Result = Linearization<WormDrive<double, Load>>;
  using Jet = typename Result::Jet;
  const Jet angle(now.x[0], 0), speed(now.x[1], 1);
  CommandedMoment<Jet> at{drive.moment(Jet(now.t), angle, speed), command<Jet>(drive, now.t, told)};
  const bool stuck = now.mode.motion == Motion::stuck;
  if (stuck) at.rest = Jet(now.t - now.since);
  const Jet acceleration = drive.acceleration(at, now.mode);
  return Result{{angle, speed},
                {stuck ? Jet(0.0) : speed, acceleration},
                drive.normal_force(drive.side_torques(at, now.mode.motion), at, acceleration, now.mode),
                drive.effects().measured_angle(angle),
                indicators.all(drive.guards(at, now.mode), now)};
}

template <class Load>
auto linearize(const CompliantDrive<double, Load>& drive, const Indicators<CompliantDrive<double, Load>>& indicators,
               const typename CompliantDrive<double, Load>::Instant& now, double told) {
  using Result = Linearization<CompliantDrive<double, Load>>;
  using Jet = typename Result::Jet;
  const std::array<Jet, 4> x{Jet(now.x[0], 0), Jet(now.x[1], 1), Jet(now.x[2], 2), Jet(now.x[3], 3)};
  const CommandedMoment<Jet> at{drive.moment(Jet(now.t), x[0], x[1], x[2], x[3]),
                                command<Jet>(drive.rigid(), now.t, told)};
  const auto a = drive.accelerations(at, now.mode);
  const auto rate = [](Motion motion, const Jet& speed) { return motion == Motion::stuck ? Jet(0.0) : speed; };
  return Result{x,
                {rate(now.mode.worm, x[1]), a.worm, rate(now.mode.gear, x[3]), a.gear},
                drive.normal_force(at, now.mode),
                drive.effects().measured_angle(x[2]),
                indicators.all(drive.guards(at, now.mode), now)};
}

}  // namespace wormdrive
