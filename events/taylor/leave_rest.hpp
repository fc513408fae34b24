#pragma once
#include <cmath>

#include "core/numbers/rounded.hpp"
#include "events/taylor/expansion.hpp"

namespace wormdrive {

/// Takes a coefficient of the speed for rounding. guard: that which is the speed in the direction of the motion.
template <class Motion>
void stay(Motion& e, int guard, int k) {
  e.omega[k] = e.theta[k + 1] = e.guards[guard][k] = 0.0;
}

/// The same motion to the other side.
template <class Motion>
void mirror(Motion& e, int guard) {
  for (int k = 1; k <= e.order; ++k)
    for (double* const c : {&e.omega[k], &e.theta[k + 1], &e.guards[guard][k]}) *c = -*c;
}

/// Motion from rest: what the start holds of speed and acceleration may be rounding, and would point anywhere. A
/// coefficient that is more than rounding counts, though another may outweigh it.
///
/// guard: that which is the speed in the direction of the motion; speed: its leading coefficients with their rounding;
/// vanishing: so many of them decide nothing; resolution: of time [s].
template <class Motion, int last>
void leave_rest(Motion& e, int guard, const Series<Rounded, last>& speed, int vanishing, double resolution) {
  // Under falling friction a rounding grows by itself. One that points against the mode would hold the motion at
  // zero, in steps as short as the growth, for ever; its mirror image is as likely.
  const Coefficients& c = e.guards[guard];
  if (vanishing > last && 2.0 * c[2] * e.step / c[1] > 1.0) return c[1] < 0.0 ? mirror(e, guard) : void();
  for (int k = 0; k <= last && k < vanishing; ++k)
    if (std::abs(speed[k].value) <= blur(speed, k, resolution)) stay(e, guard, k);
}

}  // namespace wormdrive
