#pragma once

namespace wormdrive {

/// The longest step within h up to which a series holds. A branch that an equation leaves on the way may be taken again
/// at the end, where the series then seems to hold: so the way is looked at, and not the end alone.
template <class Holds>
double longest(double h, Holds&& holds) {
  constexpr int looks = 16;
  double holding = 0.0;
  for (int k = 1; k <= looks; ++k) {
    double failing = h * k / looks;
    if (holds(failing)) {
      holding = failing;
      continue;
    }
    for (int halvings = 0; halvings < 60; ++halvings) {
      const double middle = 0.5 * (holding + failing);
      (holds(middle) ? holding : failing) = middle;
    }
    return holding;
  }
  return h;
}

}  // namespace wormdrive
