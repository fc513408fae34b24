#pragma once
#include "core/moment.hpp"

namespace wormdrive {

/// What friction between the teeth may depend on: a moment, the direction of motion, and how fast the teeth slide.
template <class S>
struct SlidingContact : Moment<S> {
  Motion motion;
  S sliding_speed;  ///< lw w_w / cos lambda [m/s], with the sign of the worm speed
};

/// Lowest and highest coefficient of friction that a drive may come to.
struct FrictionRange {
  double low, high;

  /// The same where friction rises and falls by a share of itself.
  FrictionRange spread(double share) const { return {low * (1.0 - share), high * (1.0 + share)}; }
};

}  // namespace wormdrive
