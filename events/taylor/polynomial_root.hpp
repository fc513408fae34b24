#pragma once
#include <optional>

#include "events/taylor/polynomial.hpp"

namespace wormdrive {

/// Whether a polynomial that has a root at s certainly falls there: its next minimum is lower than rounding could make
/// it, that of its value included, and than it changes within the resolution of time [s].
bool falls_through(Polynomial c, double s, double rounding, double resolution);

/// Finds where guards fall through zero within a step, and counts how often a guard had to be evaluated for it.
class RootSearch {
 public:
  /// A guard over one step.
  struct Fall {
    std::optional<double> at{};  ///< when it falls through zero, in [0, h]; a time s since the step began
    bool armed = false;          ///< it is positive somewhere before that, or by the end of the step
  };

  /// The first fall of a guard through zero within h, at the start of a segment: the given number of leading
  /// coefficients vanishes within its rounding. A guard that falls from there is over at once; one that vanishes
  /// altogether is not armed.
  Fall fall_from_start(Polynomial guard, double h, std::size_t vanishing);

  /// The first fall of a guard through zero within h, where the guard is known to an event's resolution of 10 ps only,
  /// as one that is interpolated. A guard that is not armed yet counts once it has been positive; what it is at the
  /// very start does not count.
  Fall first_fall(Polynomial guard, double h, bool armed) {
    if (!armed) return start_of_segment(guard, h);
    // An armed guard that starts below zero got there by the rounding between two steps.
    return {guard[0] <= 0.0 ? std::optional(0.0) : first_root(guard, h), true};
  }

  /// The first root in (0, h] of a polynomial that is positive at 0.
  std::optional<double> first_root(Polynomial c, double h) {
    if (stays_positive(c, h)) return std::nullopt;
    return root_within(c, h, 0);
  }

  long evaluations() const { return evaluations_; }

 private:
  std::optional<double> root_within(Polynomial c, double h, int depth);
  std::optional<double> lowest_within(Polynomial c, double h);
  std::optional<double> fall_within(Polynomial c, double h);
  Fall start_of_segment(Polynomial guard, double h);

  long evaluations_ = 0;
};

}  // namespace wormdrive
