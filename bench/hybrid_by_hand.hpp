#pragma once
#include <utility>

#include "bench/plant.hpp"

namespace bench {

/// The loop over modes that everyone writes around an integrator, with the events of this drive spelled out.
///
/// Integrator: made from a plant and a tolerance; restart(t, y, stop) takes up a state, past stop nothing is evaluated;
/// advance(t, y, end) integrates to end and returns the root at which it stopped earlier, or -1.
template <class Plant, class Integrator>
class HybridByHand {
 public:
  using Real = typename Plant::Real;
  using State = typename Plant::State;

  explicit HybridByHand(double tolerance) : integrator_(plant_, tolerance) {}
  HybridByHand(const HybridByHand&) = delete;  // the integrator keeps a pointer to the plant
  HybridByHand& operator=(const HybridByHand&) = delete;

  /// Starts at rest; what was counted is forgotten.
  void begin() {
    t_ = 0;
    y_ = {0, 0};
    plant_.mode = Mode::stuck;
    plant_.evaluations = 0;
    events_ = 0;
  }
  /// Holds a motor torque [N m] from now on, at least until stop.
  void hold(double torque, Real stop) {
    plant_.held = torque;
    plant_.mode = plant_.settle(t_, y_);
    if (plant_.mode != Mode::stuck) integrator_.restart(t_, y_, stop);
  }

  /// Runs to end, never looking past stop. event(loop) sees both sides of every event.
  template <class Listener>
  void advance(Real end, Real stop, Listener&& event) {
    while (end - t_ > instant) {
      int root = -1;
      if (plant_.mode == Mode::stuck) {
        if (!released_before(end)) return;
      } else {
        root = integrator_.advance(t_, y_, end);
        if (root < 0) return;
      }
      event(*this);
      ++events_;
      if (root == 1) {
        plant_.mode = other_flank(plant_.mode);
      } else {  // reversal or break-away
        y_[1] = 0;
        plant_.mode = plant_.from_rest(t_, y_[0]);
      }
      event(*this);
      if (plant_.mode != Mode::stuck) integrator_.restart(t_, y_, stop);
    }
    t_ = end;
  }
  void advance(Real end, Real stop) {
    advance(end, stop, [](const auto&) {});
  }

  Real t() const { return t_; }
  const State& y() const { return y_; }
  const Plant& plant() const { return plant_; }
  long evaluations() const { return plant_.evaluations; }
  int events() const { return events_; }

 private:
  static constexpr double instant = 1e-14;   ///< what no integrator can be asked to cross [s]
  static constexpr double rest_step = 2e-3;  ///< short against the inputs [s]

  /// Rests until end or until the first time at which the gear is released.
  bool released_before(Real end) {
    while (t_ < end) {
      const Real next = t_ + rest_step < end ? t_ + rest_step : end;
      if (plant_.from_rest(next, y_[0]) != Mode::stuck) {
        t_ = break_away(t_, next);
        return true;
      }
      t_ = next;
    }
    return false;
  }
  /// Bisection to the last bit: stuck at the first time, not at the second.
  Real break_away(Real stuck, Real moving) const {
    for (;;) {
      const Real middle = stuck + (moving - stuck) / 2;
      if (middle <= stuck || middle >= moving) return moving;
      (plant_.from_rest(middle, y_[0]) == Mode::stuck ? stuck : moving) = middle;
    }
  }

  Plant plant_;
  Integrator integrator_;
  Real t_ = 0;
  State y_{0, 0};
  int events_ = 0;
};

}  // namespace bench
