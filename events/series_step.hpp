#pragma once

namespace wormdrive {

/// The longest step within h over which a series holds, where it does up to some step and not beyond.
template <class Holds>
double longest(double h, Holds&& holds) {
  if (holds(h)) return h;
  double holding = 0.0, failing = h;
  for (int halvings = 0; halvings < 60; ++halvings) {
    const double middle = 0.5 * (holding + failing);
    (holds(middle) ? holding : failing) = middle;
  }
  return holding;
}

}  // namespace wormdrive
