#pragma once
#include <algorithm>
#include <vector>

#include "judge/course.hpp"

namespace judge {

/// Runs a drive by rules of its own: what happens after an event is what the first derivative says that is not zero.
template <class Real>
class Judge {
 public:
  /// An event's time in the judge's own numbers beside that in doubles.
  struct Found : Event {
    Real exact;
  };

  /// It gives up after so many steps or 400 events, unless more are allowed.
  explicit Judge(const Drive& drive, long most_steps = 6000, std::size_t most_events = 400)
      : course_(drive, most_steps), end_(drive.end), most_events_(most_events) {}

  /// Runs to the end. Throws GivesUp after too many steps or events.
  const std::vector<Found>& run() {
    enter(0.0);
    while (course_.t < Real(end_)) {
      const double knot = course_.next_knot();
      const Real stop = std::min(knot, end_);
      const bool arrived = mode.motion == 0 ? wait(stop) : move(stop);
      if (arrived && knot < end_) enter(knot);
    }
    return events;
  }

  Mode start;  ///< behind the settling at t = 0
  Mode mode;
  std::vector<Found> events;
  const EventSequence<Real>& course() const { return course_; }

 private:
  void enter(double t) {
    course_.enter(t);
    const Mode before = mode;
    if (course_.omega == 0)
      leave_rest();
    else
      fold_into_parameters(course_.omega > 0 ? 1 : -1);
    if (t == 0.0)
      start = mode;
    else if (!(mode == before))
      note(before);
  }

  /// Whether it arrives at the stop without an event; likewise move().
  bool wait(Real stop) {
    Real h = stop - course_.t, released = -1;
    int sigma = 0;
    for (int direction : {1, -1}) {
      const auto at_rest = course_.resting(direction, h);
      if (at_rest.step < h) h = at_rest.step, released = released < h ? released : Real(-1);
      const Real first = both(at_rest, direction, h);
      if (first >= 0 && (released < 0 || first < released)) released = first, sigma = direction;
    }
    if (released < 0) return go(stop, h);
    course_.t += released;
    const Mode before = mode;
    fold_into_parameters(sigma);
    note(before);
    return false;
  }
  /// The first time within h at which the pulls on both flanks have the direction's sign, else -1.
  static Real both(const typename EventSequence<Real>::Resting& at_rest, int direction, Real h) {
    const auto left = signs(at_rest.pull[1], h), right = signs(at_rest.pull[0], h);
    const auto sign_at = [](const std::vector<Span<Real>>& spans, Real s) {
      int sign = 0;
      for (const auto& span : spans)
        if (span.from <= s) sign = span.sign;
      return sign;
    };
    Real first = -1;
    for (const auto* spans : {&left, &right})
      for (const auto& span : *spans)
        if (sign_at(left, span.from) == direction && sign_at(right, span.from) == direction)
          if (first < 0 || span.from < first) first = span.from;
    return first;
  }

  bool move(Real stop) {
    const auto ahead = course_.ahead(mode, stop - course_.t);
    const Real speed_ends = first_negative(ahead.omega, mode.motion, ahead.step),
               flank_ends = mode.flank == 0 ? Real(-1) : first_negative(ahead.beyond, -mode.flank, ahead.step);
    const bool stops = speed_ends >= 0 && (flank_ends < 0 || speed_ends <= flank_ends);
    const Real s = stops ? speed_ends : flank_ends;
    const Real h = s >= 0 ? s : ahead.step;
    course_.theta = value(ahead.theta, h);
    course_.omega = value(ahead.omega, h);
    if (s < 0) return go(stop, h);
    course_.t += s;
    const Mode before = mode;
    if (stops) {
      course_.omega = 0;
      course_.since = course_.t;
      leave_rest();
    } else {
      mode.flank = -mode.flank;
    }
    note(before);
    return false;
  }
  static Real first_negative(const std::vector<Real>& c, int factor, Real h) {
    for (const auto& span : signs(c, h))
      if (span.sign == -factor) return span.from;
    return -1;
  }
  bool go(Real stop, Real h) {
    const bool arrives = course_.t + h >= stop || h >= stop - course_.t;
    course_.t = arrives ? stop : course_.t + h;
    return arrives;
  }

  void leave_rest() {
    const Real h = std::max(Real(end_) - course_.t, Real(1e-9));
    mode = {};
    for (int direction : {1, -1}) {
      const auto at_rest = course_.resting(direction, h);
      if (lead(at_rest.pull[0], at_rest.step) == direction && lead(at_rest.pull[1], at_rest.step) == direction)
        return fold_into_parameters(direction);
    }
  }
  /// Moves in a direction, on the flank that this loads just after now.
  void fold_into_parameters(int direction) {
    mode = {direction, 0};
    if (!course_.drive().teeth) return;
    const auto ahead = course_.ahead({direction, 1}, std::max(Real(end_) - course_.t, Real(1e-9)));
    mode.flank = lead(ahead.beyond, ahead.step) <= 0 ? 1 : -1;
  }
  void note(Mode before) {
    events.push_back({{static_cast<double>(course_.t), before, mode}, course_.t});
    if (events.size() > most_events_) throw GivesUp("too many events");
  }

  EventSequence<Real> course_;
  double end_;
  std::size_t most_events_;
};

}  // namespace judge
