#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "bindings/fmi/variables.hpp"

namespace wormdrive {

/// How far an indicator lies above its guard: behind an event no guard of the new mode stands at exactly 0, and a guard
/// that only touches 0 makes no event.
inline constexpr double hysteresis = 1e-12;

/// What a guard of a drive is divided by to be about 1, in the order of the indicators.
template <class Load, bool with_states>
auto indicator_scales(const WormDrive<double, Load, with_states>& drive,
                      const typename WormDrive<double, Load, with_states>::Instant& now) {
  const auto rest = drive.guards(drive.moment(now), Mode{});
  const double a = std::max(std::abs(rest[0]), std::abs(rest[1])), acceleration = a > 0.0 && std::isfinite(a) ? a : 1.0;
  const double surface = drive.mesh().has_teeth ? acceleration * drive.mesh().Jw * drive.mesh().i : 1.0;
  std::array<double, Interface<WormDrive<double, Load, with_states>>::indicators.size()> scales;
  scales.fill(1.0);  // of the way to a stop
  std::ranges::copy(std::array{std::sqrt(acceleration), surface, acceleration, acceleration}, scales.begin());
  return scales;
}
template <class Load>
auto indicator_scales(const CompliantDrive<double, Load>& drive,
                      const typename CompliantDrive<double, Load>::Instant& now) {
  const double torque = std::abs(drive.rigid().inputs(drive.moment(now), now.mode.gear).gear), Jg = drive.rigid().Jg();
  const double gear = torque > 0.0 ? torque / Jg : 1.0, worm = gear * drive.mesh().i;
  const double force = gear * Jg / drive.mesh().lg;
  const double gap = std::max(0.5 * drive.contact().backlash * drive.mesh().lg, force / drive.contact().stiffness());
  return std::array{force, gap, gap, std::sqrt(worm), worm, worm, std::sqrt(gear), gear, gear};
}

/// The guards of a drive as event indicators: of the order of 1, and positive while the mode holds.
template <class Drive>
class Indicators {
 public:
  using Instant = typename Drive::Instant;
  using Ports = Interface<Drive>;
  static constexpr std::size_t count = Ports::indicators.size();

  /// Scaled by the torques at an instant.
  Indicators(const Drive& drive, const Instant& now) : scales_(indicator_scales(drive, now)) {}

  /// Of the guards that the present mode has, in their order.
  std::array<double, Drive::guard_count> of_guards(const Drive& drive, const Instant& now) const {
    std::array<double, Drive::guard_count> z = scaled(drive.guards(drive.moment(now), now.mode), now);
    for (double& one : z)
      if (one == 0.0) one = -std::numeric_limits<double>::min();
    return z;
  }
  /// Of all guards; those of other modes are 1.
  std::array<double, count> all(const Drive& drive, const Instant& now) const {
    return spread(of_guards(drive, now), now);
  }
  /// The same of guards that are known, with their derivatives.
  template <class S>
  std::array<S, count> all(const std::array<S, Drive::guard_count>& guards, const Instant& now) const {
    return spread(scaled(guards, now), now);
  }

  /// What the guards are divided by, for a copy that starts elsewhere.
  std::array<double, count>& scales() { return scales_; }
  const std::array<double, count>& scales() const { return scales_; }

 private:
  /// A gear behind an impact is on its way to another stop: nothing stands at 0. Raised, a stop would give a gear the
  /// way back that it has made beyond it, and small bounces would never end.
  static constexpr double raised_by(int guard) {
    if constexpr (requires { Drive::stop_guard; })
      if (guard == Drive::stop_guard) return 0.0;
    return hysteresis;
  }
  template <class S>
  std::array<S, Drive::guard_count> scaled(std::array<S, Drive::guard_count> guards, const Instant& now) const {
    for (int g = 0; g < Drive::guard_count; ++g) guards[g] = guards[g] / scales_[index(now, g)] + raised_by(g);
    return guards;
  }
  template <class S>
  static std::array<S, count> spread(const std::array<S, Drive::guard_count>& present, const Instant& now) {
    std::array<S, count> z;
    z.fill(S(1.0));
    for (int g = Drive::guard_count - 1; g >= 0; --g) z[index(now, g)] = present[g];  // of one name the first counts
    return z;
  }
  static std::size_t index(const Instant& now, int guard) {
    const auto& names = Ports::indicators;
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), Drive::guard_name(now.mode, guard)) -
                                    names.begin());
  }

  std::array<double, count> scales_;
};

/// How many changes of mode there were, and when the latest was.
struct EventTally {
  int count = 0;
  double latest = 0.0;  ///< [s]; the start, before the first

  void add(double t) {
    ++count;
    latest = t;
  }
};

}  // namespace wormdrive
