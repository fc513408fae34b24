#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include "bindings/fmi/variables.hpp"
#include "core/elastic/compliant_start.hpp"
#include "core/initial_state.hpp"

namespace wormdrive {

/// How far an indicator lies above its guard: behind an event no guard of the new mode stands at exactly 0, and a guard
/// that only touches 0 makes no event.
inline constexpr double hysteresis = 1e-10;

/// What a guard of a drive is divided by to be about 1, in the order of the indicators.
template <class Load>
auto indicator_scales(const WormDrive<double, Load>& drive, const typename WormDrive<double, Load>::Instant& now) {
  const auto rest = drive.guards(drive.moment(now), Mode{});
  const double a = std::max(std::abs(rest[0]), std::abs(rest[1])), acceleration = a > 0.0 && std::isfinite(a) ? a : 1.0;
  const double surface = drive.mesh().has_teeth ? acceleration * drive.mesh().Jw * drive.mesh().i : 1.0;
  return std::array{std::sqrt(acceleration), surface, acceleration, acceleration};
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

/// A drive as an importer moves it: it sets time, state and motor torque, and asks for derivatives and indicators;
/// which mode holds is decided here, in event mode only.
template <class Drive>
class PlantRun {
 public:
  using Ports = Interface<Drive>;
  static constexpr std::size_t state_size = Drive::state_size, indicator_count = Ports::indicators.size();

  /// Starts at t [s] with a motor torque [N m].
  PlantRun(Drive drive, const InitialState<double>& initial, double t, double torque)
      : drive_(std::move(drive)), torque_(torque), commanded_(torque) {
    drive_.enter(t);
    drive_.command(t, torque);
    now_.t = t;
    if constexpr (requires { carrying(drive_, t, 0.0, 0.0); })
      now_.x = carrying(drive_, t, initial.theta_g, initial.omega_g);
    else
      now_.x = {initial.theta_g, initial.omega_g};
    now_.mode = drive_.settle(now_);
    scales_ = indicator_scales(drive_, now_);
    knot_ = drive_.next_knot(t);
  }

  void set_time(double t) { now_.t = t; }
  void set_state(const double* x) { std::copy_n(x, state_size, now_.x.data()); }
  void state(double* x) const { std::copy_n(now_.x.data(), state_size, x); }
  double torque() const { return torque_; }
  /// jumps: the torque is set in event mode, where it need not be continuous.
  void set_torque(double torque, bool jumps) {
    jumped_ = jumped_ || (jumps && torque != torque_);
    torque_ = torque;
  }

  void rates(double* rate) {
    take_torque();
    const auto x = drive_.derivative(now_.t, now_.x, now_.mode);
    std::copy_n(x.data(), state_size, rate);
  }
  /// Of the guards that the present mode has; those of other modes are 1.
  void indicators(double* z) {
    std::fill_n(z, indicator_count, 1.0);
    const auto of_guards = guards();
    for (int g = Drive::guard_count - 1; g >= 0; --g) z[indicator(g)] = of_guards[g];  // of one name the first counts
  }
  Observation observe() {
    take_torque();
    return drive_.observe(now_);
  }
  double measured_angle() const { return drive_.measured_angle(now_); }

  /// Passes all events that are due at the present time.
  void pass_events() {
    fire_guards();
    if (now_.t >= knot_) {
      drive_.enter(now_.t);
      knot_ = drive_.next_knot(now_.t);
      jumped_ = true;
    }
    if (jumped_) now_.mode = drive_.settle(now_);
    jumped_ = false;
  }
  /// The next time at which the load jumps or bends [s]; infinity without one.
  double next_event_time() const { return knot_; }

 private:
  void take_torque() {
    if (torque_ == commanded_) return;
    drive_.command(now_.t, torque_);
    commanded_ = torque_;
  }
  std::size_t indicator(int guard) const {
    const auto& names = Ports::indicators;
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), Drive::guard_name(now_.mode, guard)) -
                                    names.begin());
  }
  std::array<double, Drive::guard_count> guards() {
    take_torque();
    std::array<double, Drive::guard_count> z = drive_.guards(drive_.moment(now_), now_.mode);
    for (int g = 0; g < Drive::guard_count; ++g) {
      z[g] = z[g] / scales_[indicator(g)] + hysteresis;
      if (z[g] == 0.0) z[g] = -std::numeric_limits<double>::min();
    }
    return z;
  }
  /// Events that follow from one another at one time are few; the limit is there for a state that is none.
  void fire_guards() {
    for (int round = 0; round < 3 * Drive::guard_count; ++round) {
      const auto z = guards();
      const auto lowest = std::min_element(z.begin(), z.end());
      if (*lowest > 0.0) return;
      const auto before = now_.mode;
      now_ = drive_.jump(now_, static_cast<int>(lowest - z.begin()));
      // A drive that does not know how its torque goes on may take a surface that was passed for one only touched.
      if constexpr (std::is_same_v<typename Drive::Mode, Mode>)
        if (now_.mode == before) now_.mode.flank = before.flank == Flank::left ? Flank::right : Flank::left;
    }
  }

  Drive drive_;
  typename Drive::Instant now_{};
  double torque_, commanded_;
  bool jumped_ = false;
  std::array<double, indicator_count> scales_;
  double knot_;
};

}  // namespace wormdrive
