#pragma once
#include <algorithm>
#include <array>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

#include "bindings/fmi/shown.hpp"
#include "core/states/starting_state.hpp"
#include "simulation/stepping/drive_numbers.hpp"

namespace wormdrive {

/// A drive as an importer moves it: it sets time, state and motor torque, and asks for derivatives and indicators;
/// which mode holds is decided here, in event mode only.
template <class Drive>
class PlantRun {
 public:
  using System = Drive;
  using Ports = Interface<Drive>;
  static constexpr std::size_t state_size = Drive::state_size, indicator_count = Ports::indicators.size();
  using States = std::array<double, state_size>;

  /// Starts at t [s] with a motor torque [N m].
  PlantRun(Drive drive, const InitialState<double>& initial, double t, double torque)
      : drive_(std::move(drive)),
        torque_(torque),
        commanded_(torque),
        present_(present_states<Drive>(drive_.effects())),
        now_(start(drive_, initial, t, torque)),
        indicators_(drive_, now_),
        entered_(t),
        knot_(drive_.next_knot(t)),
        events_{0, t} {}

  void set_time(double t) { now_.t = t; }
  /// The places of the states that an importer sees.
  const std::vector<std::size_t>& present() const { return present_; }
  /// x: of the states that it sees.
  void set_states(const double* x) {
    for (const std::size_t k : present_) now_.x[static_cast<Eigen::Index>(k)] = *x++;
  }
  States states() const {
    States x;
    std::copy_n(now_.x.data(), state_size, x.begin());
    return x;
  }
  /// jumps: the torque is set in event mode, where it need not be continuous.
  void set_torque(double torque, bool jumps) {
    jumped_ = jumped_ || (jumps && torque != torque_);
    torque_ = torque;
  }

  States rates() {
    take_torque();
    const auto x = drive_.derivative(now_.t, now_.x, now_.mode);
    States rate;
    std::copy_n(x.data(), state_size, rate.begin());
    return rate;
  }
  std::array<double, indicator_count> indicators() {
    take_torque();
    return indicators_.all(drive_, now_);
  }
  /// What is shown, with the derivatives that derivative_by() counts.
  auto linearization() {
    take_torque();
    return linearize(drive_, indicators_, now_, torque_);
  }
  Observation observe() {
    take_torque();
    return drive_.observe(now_);
  }
  double measured_angle() const { return drive_.measured_angle(now_); }
  const EventTally& events() const { return events_; }

  /// Passes all events that are due at the present time.
  void pass_events() {
    const auto before = now_.mode;
    fire_guards();
    if (now_.t >= knot_) {
      drive_.enter(now_.t);
      entered_ = now_.t;
      knot_ = drive_.next_knot(now_.t);
      jumped_ = true;
    }
    if (jumped_) now_.mode = drive_.settle(now_);
    jumped_ = false;
    if (!(now_.mode == before)) events_.add(now_.t);
  }
  /// The next time at which the load jumps or bends [s]; infinity without one.
  double next_event_time() const { return knot_; }

  // ---- as numbers ------------------------------------------------------------------------------------------------

  /// All that changes; the same bits follow from them.
  void write(std::vector<double>& to) const {
    write_instant<Drive>(now_, to);
    to.insert(to.end(), {torque_, commanded_, entered_, knot_, double(jumped_), double(events_.count), events_.latest});
    to.insert(to.end(), indicators_.scales().begin(), indicators_.scales().end());
  }
  /// Takes up such numbers; false where they are none. The run has to be a fresh one of the same model.
  bool read(std::span<const double> from) {
    NumberReader next(from);
    const auto now = read_instant<Drive>(next);
    if (!now) return false;
    now_ = *now;
    torque_ = next();
    commanded_ = next();
    entered_ = next();
    knot_ = next();
    jumped_ = next() != 0.0;
    events_.count = static_cast<int>(next());
    events_.latest = next();
    for (double& scale : indicators_.scales()) scale = next();
    drive_.enter(entered_);
    drive_.command(entered_, commanded_);
    return next.rest().empty();
  }

 private:
  static typename Drive::Instant start(Drive& drive, const InitialState<double>& initial, double t, double torque) {
    drive.enter(t);
    drive.command(t, torque);
    typename Drive::Instant now{};
    now.t = t;
    now.x = starting_state(drive, initial, t);
    now.mode = drive.settle(now);
    return now;
  }
  void take_torque() {
    if (torque_ == commanded_) return;
    drive_.command(now_.t, torque_);
    commanded_ = torque_;
  }
  /// Events that follow from one another at one time are few; the limit is there for a state that is none.
  void fire_guards() {
    for (int round = 0; round < 3 * Drive::guard_count; ++round) {
      take_torque();
      const auto z = indicators_.of_guards(drive_, now_);
      if (*std::min_element(z.begin(), z.end()) > 0.0) return;
      // Teeth that part take their friction along: the break-in of a shaft passes zero with them. The contact, whose
      // guards come first, is what ends, though it may lie within its lift yet.
      const auto fallen = shaft_count<Drive>() == 2
                              ? std::find_if(z.begin(), z.end(), [](double g) { return g < hysteresis; })
                              : std::min_element(z.begin(), z.end());
      const auto before = now_.mode;
      now_ = drive_.jump(now_, static_cast<int>(fallen - z.begin()));
      // A drive that does not know how its torque goes on may take a surface that was passed for one only touched.
      if constexpr (std::is_same_v<typename Drive::Mode, Mode>)
        if (now_.mode == before) now_.mode.flank = before.flank == Flank::left ? Flank::right : Flank::left;
    }
  }

  Drive drive_;
  double torque_, commanded_;
  std::vector<std::size_t> present_;
  typename Drive::Instant now_;
  Indicators<Drive> indicators_;
  double entered_;  ///< when the load was last frozen to its piece [s]
  double knot_;
  EventTally events_;
  bool jumped_ = false;
};

}  // namespace wormdrive
