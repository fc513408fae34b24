#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <tuple>

#include "core/effects.hpp"
#include "core/numbers/rounded.hpp"

namespace wormdrive {

/// The hard stops of the gear, if there are any.
template <class T>
const std::optional<HardStops<T>>& hard_stops(const Effects<T>& effects) {
  return std::get<std::optional<HardStops<T>>>(effects.list);
}

/// Way to the stop ahead of a motion [rad]; one where there is none.
template <class T, class S>
S way_to_stop(const Effects<T>& effects, const S& theta_g, Motion motion) {
  const auto& stops = hard_stops(effects);
  if (!stops || motion == Motion::stuck || !stops->ahead(motion)) return S(T(1));
  return T(sign(motion)) * (S(*stops->ahead(motion)) - theta_g);
}

/// Whether the gear is where it cannot go on in a direction.
template <class T, class S>
bool is_at_stop(const Effects<T>& effects, const S& theta_g, Motion motion) {
  return hard_stops(effects) && !is_positive(way_to_stop(effects, theta_g, motion));
}

/// Speed of the gear behind an impact, away from the stop, and the impulse that it takes.
struct ImpactOnStop {
  double speed, impulse;
};

/// An impact on the stop ahead. While it stops the gear the worm drives that against the stop, and while it drives it
/// back the gear drives the worm, with the friction of the mesh: one that locks itself stays. A share restitution^2 of
/// the energy that the stop takes comes back [Stronge2000, eq. 3.17], as from a spring that becomes ever stiffer.
template <class Drive, class M>
ImpactOnStop impact_on_stop(const Drive& drive, const M& at, Motion into) {
  using Torques = typename Drive::template SideTorques<double>;
  const double away = -sign(into);
  const bool teeth = drive.mesh().has_teeth;
  // an impulse on the gear is borne by the flank that carries a load of its direction
  const Flank flank = !teeth ? Flank::none : into == Motion::forward ? Flank::right : Flank::left;
  const auto gives = [&](Motion motion) {  // speed per impulse [1/(kg m^2)]
    const Mode mode{motion, flank};
    return away * (drive.acceleration(Torques{0.0, away}, at, mode) - drive.acceleration(Torques{0.0, 0.0}, at, mode));
  };
  const double speed = std::abs(at.omega_g), taken = gives(into),
               given = std::max(0.0, gives(into == Motion::forward ? Motion::backward : Motion::forward));
  const double back = hard_stops(drive.effects())->restitution * speed * std::sqrt(given / taken);
  return {back, speed / taken + (given > 0.0 ? back / given : 0.0)};
}

/// Whether the gear would be back at a stop before its way or its time could be told from nothing: without an end to
/// ever smaller bounces a run would not come through them.
template <class Drive, class Instant>
bool is_back_at_once(const Drive& drive, const Instant& now, Motion into) {
  const auto& stops = hard_stops(drive.effects());
  const double speed = std::abs(now.x[1]), pull = sign(into) * drive.acceleration(drive.moment(now), drive.settle(now));
  if (pull <= 0.0) return false;
  constexpr double resolution = 16.0 * std::numeric_limits<double>::epsilon();
  const double size = std::max(std::abs(stops->low.value_or(0.0)), std::abs(stops->high.value_or(0.0)));
  return 2.0 * speed / pull <= resolution * std::abs(now.t) || 0.5 * speed * speed / pull <= resolution * size;
}

/// Lets the gear hit the stop ahead.
template <class Drive, class Instant>
void strike(const Drive& drive, Instant& now) {
  const Motion into = now.mode.motion;
  now.x[0] = *hard_stops(drive.effects())->ahead(into);
  const ImpactOnStop impact = impact_on_stop(drive, drive.moment(now), into);
  now.x[1] = -sign(into) * impact.speed;
  now.x[2 + StateLayout<EffectList<double>>::first<HardStops<double>>()] -= sign(into) * impact.impulse;
  if (now.x[1] != 0.0 && is_back_at_once(drive, now, into)) now.x[1] = 0.0;
}

/// Torque on the gear of a stop that takes what pushes into it while the gear rests there [N m]; tau without it.
template <class Drive, class M, class Torques>
double torque_of_stop(const Drive& drive, const M& at, const Torques& tau) {
  for (const Motion way : {Motion::forward, Motion::backward}) {
    if (!is_at_stop(drive.effects(), at.theta_g, way)) continue;
    const double beyond = drive.beyond_surface(tau, at);
    const Mode mode{way, !drive.mesh().has_teeth ? Flank::none : beyond > 0.0 ? Flank::right : Flank::left};
    if (sign(way) * drive.acceleration(tau, at, mode) <= 0.0) continue;
    return -tau.worm / drive.mesh().C(drive.signed_friction(at, mode)) - tau.gear;
  }
  return 0.0;
}

}  // namespace wormdrive
