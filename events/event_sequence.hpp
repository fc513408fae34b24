#pragma once
#include <vector>

#include "events/bend_watch.hpp"
#include "events/simulate.hpp"

namespace wormdrive {

/// The course of a run: every stop of the loop with both its sides. What is derived along a run is carried from stop to
/// stop, and no event is searched for twice.
template <class System>
class EventSequence {
 public:
  using Instant = typename System::Instant;
  struct Stop {
    Cause cause;
    Instant before, after;  ///< left and right limit, at one time
    double disturbance{};   ///< of the worm's shaft from here on [N m]
    double hidden{};        ///< for so long [s] rounding hides on which side of a bend the motion is

    /// Only looked at: nothing changes at a report and at the end.
    bool passed() const { return cause.reason == Reason::report || cause.reason == Reason::end; }
    bool changes_mode() const { return !(before.mode == after.mode); }
    bool is_bend() const { return cause.reason == Reason::guard && cause.guard == BendWatch<System>::guard; }
  };

  /// begin: what the run is started with.
  explicit EventSequence(const Instant& begin) : left_(begin) {}

  void operator()(const System& system, const Instant& now, const Cause& cause) {
    Stop stop{cause, now, now};
    if constexpr (requires { system.disturbance(); }) stop.disturbance = system.disturbance();
    if (open_) stop.before = left_;
    if (open_ && stop.is_bend()) stop.hidden = BendWatch<System>(system).hidden_for(now);
    if (open_ || stop.passed()) stops_.push_back(stop);
    open_ = !open_ && !stop.passed();
    left_ = now;
  }

  const std::vector<Stop>& stops() const { return stops_; }

 private:
  Instant left_;
  bool open_ = true;  ///< the left side of a stop is known, the right one is to come; of the first it is the start
  std::vector<Stop> stops_;
};

}  // namespace wormdrive
