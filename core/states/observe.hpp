#pragma once
#include "core/elastic/observation.hpp"
#include "core/states/impact_on_stop.hpp"
#include "core/states/winding.hpp"

namespace wormdrive {

/// What a rigid drive shows at an instant; the torque on its gear is that of the load and of a stop on which it rests.
template <class Drive>
Observation observation(const Drive& drive, const typename Drive::Instant& now) {
  const auto at = drive.moment(now);
  const bool stuck = now.mode.motion == Motion::stuck;
  auto input = drive.inputs(at, now.mode.motion), tau = drive.side_torques(input, at, now.mode.motion);
  if constexpr (requires { at.states; })
    if (const double stop = stuck ? torque_of_stop(drive, at, input) : 0.0; stop != 0.0) {
      input.gear += stop;
      tau.gear += stop;
    }
  const double alpha = stuck ? 0.0 : drive.acceleration(tau, at, now.mode);
  Observation o{.theta_g = now.x[0],
                .omega_g = now.x[1],
                .alpha_g = alpha,
                .tau_m = input.worm,
                .tau_l = input.gear,
                .normal_force = drive.normal_force(tau, at, alpha, now.mode),
                .mode = now.mode,
                .winding = winding(drive.effects(), drive.motor_command(at.t), at)};
  if constexpr (requires { at.states; }) o.states = at.states;
  return o;
}

}  // namespace wormdrive
