#pragma once
#include <algorithm>
#include <cmath>
#include <limits>

namespace wormdrive {

/// Why an integration pauses.
enum class Reason {
  knot,    ///< an input jumps or bends
  guard,   ///< a guard of the present mode fell through zero
  report,  ///< a row is due; nothing changes
  end,
};

/// The time events of a run: knots of the inputs, reports at begin + k interval, the end.
class Timetable {
 public:
  /// Times in s; report_interval > 0, infinity for none.
  Timetable(double begin, double end, double report_interval)
      : begin_(begin), end_(end), interval_(report_interval), knot_(begin) {}

  /// The next time event of any kind.
  double next_time() const { return std::min(next_stop(), report()); }
  /// The next time past which no solver may look: behind it the inputs differ.
  double next_stop() const { return std::min(knot_, end_); }

  /// Takes the event that is due at next_time(); of simultaneous ones a knot goes first and the end last.
  Reason pop() {
    const double t = next_time();
    if (knot_ <= t && knot_ < end_) {
      knot_ = std::numeric_limits<double>::infinity();
      return Reason::knot;
    }
    if (report() <= t) {
      ++reports_;
      return Reason::report;
    }
    return Reason::end;
  }

  void schedule_knot(double t) { knot_ = t; }

 private:
  /// Counted, not accumulated, so that the k-th report is where its number says; one on the end is the end's own row.
  double report() const {
    const double t = begin_ + static_cast<double>(reports_) * interval_;
    return t < end_ - 1e-9 * interval_ ? t : std::numeric_limits<double>::infinity();
  }

  double begin_, end_, interval_, knot_;
  long reports_ = 1;
};

/// True where so little time is left that a solver could not take a step: at most 2 ulp of t.
inline bool already_there(double t, double target) {
  return target - t <= 2.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(t), std::abs(target));
}

}  // namespace wormdrive
