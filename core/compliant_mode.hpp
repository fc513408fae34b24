#pragma once
#include "core/mode.hpp"

namespace wormdrive {

enum class Shaft { worm, gear };

/// The discrete state of the compliant drive: where the teeth touch and how each shaft moves.
struct CompliantMode {
  Flank contact = Flank::none;  ///< none: free in the gap
  /// A shaft whose torques do not depend on its direction is never stuck: it is forward throughout.
  Motion worm = Motion::stuck, gear = Motion::stuck;

  constexpr Motion operator[](Shaft shaft) const { return shaft == Shaft::worm ? worm : gear; }
  constexpr CompliantMode with(Shaft shaft, Motion motion) const {
    return shaft == Shaft::worm ? CompliantMode{contact, motion, gear} : CompliantMode{contact, worm, motion};
  }
  /// As the rigid drive would call it: the motion of the worm, on which the friction of the teeth acts.
  constexpr operator Mode() const { return {worm, contact}; }  // NOLINT(google-explicit-constructor): for reports
  friend constexpr bool operator==(const CompliantMode&, const CompliantMode&) = default;
};

}  // namespace wormdrive
