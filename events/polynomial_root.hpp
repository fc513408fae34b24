#pragma once
#include <optional>

#include "events/polynomial.hpp"

namespace wormdrive {

/// Number of leading coefficients that vanish next to their successor within the resolution of an event, as
/// sign_just_after judges them: the polynomial has that many roots at s = 0. All of them where nothing remains.
std::size_t start_roots(Polynomial c);

/// Whether a polynomial that has a root at s certainly falls there, and for longer than an instant [s].
bool falls_through(Polynomial c, double s, double instant);

/// Finds where guards fall through zero within a step, and counts how often a guard had to be evaluated for it.
class RootSearch {
 public:
  /// A guard over one step.
  struct Fall {
    std::optional<double> at{};  ///< when it falls through zero, in [0, h]; a time s since the step began
    bool armed = false;          ///< it is positive somewhere before that, or by the end of the step
  };

  /// The first fall of a guard through zero within h. A guard that is not armed yet counts once it has been positive;
  /// what it is at the very start, to rounding, does not count.
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
