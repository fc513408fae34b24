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

/// What an impact comes to: the impulse that stops the gear, the one that drives it back, and its speed then.
template <class T>
struct ImpactOnStop {
  T stopping, driving, speed;
};

/// A part of this that the mesh passes on is rounding: such a gear locks itself.
inline constexpr double rounding_of_mesh = 16.0 * std::numeric_limits<double>::epsilon();

/// A mode in which the worm drives the gear in a direction, or the gear the worm.
template <class Drive>
Mode driven_by_worm(const Drive& drive, Motion way, bool worm) {
  if (!drive.mesh().has_teeth) return {way, Flank::none};
  return {way, (way == Motion::forward) == worm ? Flank::right : Flank::left};
}

/// An impact on a stop. While it stops the gear the worm drives that against the stop, and while it drives it
/// back the gear drives the worm, with the friction of the mesh: one that locks itself stays. A share restitution^2 of
/// the energy that the stop takes comes back (Stronge), as from a spring that becomes ever stiffer.
template <class Drive, class T, template <class> class M>
ImpactOnStop<T> impact_on_stop(const Drive& drive, const M<T>& at, Motion into) {
  using std::sqrt;  // Jets have their own
  using Torques = typename Drive::template SideTorques<T>;
  const T away(-sign(into)), none(0.0), speed = T(sign(into)) * at.omega_g;
  const auto gives = [&](Mode mode) -> T {  // speed per impulse [1/(kg m^2)]
    return away *
           (drive.acceleration(Torques{none, away}, at, mode) - drive.acceleration(Torques{none, none}, at, mode));
  };
  const Motion out = into == Motion::forward ? Motion::backward : Motion::forward;
  const T taken = gives(driven_by_worm(drive, into, true)), given = gives(driven_by_worm(drive, out, false));
  if (given <= T(rounding_of_mesh) * taken) return {speed / taken, none, none};
  const T back = hard_stops(drive.effects())->restitution * speed * sqrt(given / taken);
  return {speed / taken, back / given, back};
}

/// Whether the gear would be back at a stop before its way or its time could be told from nothing: without an end to
/// ever smaller bounces a run would not come through them.
template <class Drive, class Instant>
bool is_back_at_once(const Drive& drive, const Instant& now, Motion into) {
  const auto& stops = hard_stops(drive.effects());
  const double speed = std::abs(now.x[1]), pull = sign(into) * drive.acceleration(drive.moment(now), drive.settle(now));
  if (pull <= 0.0) return false;
  constexpr double resolution = 16.0 * std::numeric_limits<double>::epsilon();
  // a bounce that loses less than the rounding of its angle gives it back would never end
  const double lost = 1.0 - stops->restitution * stops->restitution,
               least = lost > 0.0 ? resolution / lost : resolution;
  const double size = std::max(std::abs(stops->low.value_or(0.0)), std::abs(stops->high.value_or(0.0)));
  return 2.0 * speed / pull <= resolution * std::abs(now.t) || 0.5 * speed * speed / pull <= least * size;
}

/// Lets the gear hit the stop ahead, which throws it back as long as that makes a difference: comes_back(state) tells.
template <class Drive, class Instant, class ComesBack>
void strike(const Drive& drive, Instant& now, const ComesBack& comes_back) {
  using T = typename Drive::State::Scalar;
  const Motion into = now.mode.motion;
  now.x[0] = *hard_stops(drive.effects())->ahead(into);
  const ImpactOnStop<T> impact = impact_on_stop(drive, drive.moment(now), into);
  now.x[1] = T(-sign(into)) * impact.speed;
  if (now.x[1] != T(0.0) && !comes_back(now)) now.x[1] = T(0.0);
  now.x[2 + StateLayout<EffectList<T>>::template first<HardStops<T>>()] -=
      T(sign(into)) * (now.x[1] != T(0.0) ? impact.stopping + impact.driving : impact.stopping);
}
template <class Drive, class Instant>
void strike(const Drive& drive, Instant& now) {
  const Motion into = now.mode.motion;
  strike(drive, now, [&](const Instant& then) { return !is_back_at_once(drive, then, into); });
}

/// Takes a gear that is beyond a stop by what a solver errs back to it.
template <class T>
void keep_between_stops(const Effects<T>& effects, T& theta_g) {
  const auto& stops = hard_stops(effects);
  if (!stops) return;
  if (stops->low) theta_g = std::max(theta_g, *stops->low);
  if (stops->high) theta_g = std::min(theta_g, *stops->high);
}

/// Torque on the gear of a stop that takes what pushes into it while the gear rests there [N m]: as much as keeps it
/// from moving with the friction of mesh and bearings on its side.
template <class Drive, class M, class Torques>
double torque_of_stop(const Drive& drive, const M& at, const Torques& input) {
  for (const Motion way : {Motion::forward, Motion::backward}) {
    if (!is_at_stop(drive.effects(), at.theta_g, way)) continue;
    const Torques tau = drive.side_torques(input, at, way);
    const auto C = [&](bool worm) {
      return drive.mesh().C(drive.signed_friction(at, driven_by_worm(drive, way, worm)));
    };
    const bool by_worm = sign(way) * tau.worm > 0.0;
    if (!by_worm && C(false) <= rounding_of_mesh * C(true)) continue;  // it locks itself, whatever the load
    const double stop = -tau.worm / C(by_worm) - tau.gear;
    if (sign(way) * stop < 0.0) return stop;
  }
  return 0.0;
}

}  // namespace wormdrive
