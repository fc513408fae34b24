#pragma once
#include <string_view>

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

inline constexpr int contact_guards = 0, worm_guards = 2, gear_guards = 4;  ///< first of two for each

/// What a guard of the compliant drive watches in a mode.
constexpr std::string_view name_of_guard(CompliantMode mode, int guard) {
  if (guard < worm_guards) {
    if (mode.contact != Flank::none) return "normal force";
    return guard == contact_guards ? "left gap" : "right gap";
  }
  const bool worm = guard < gear_guards, first = guard % 2 == 0;
  if (mode[worm ? Shaft::worm : Shaft::gear] != Motion::stuck) return worm ? "worm speed" : "gear speed";
  if (worm) return first ? "forward break-in of the worm" : "backward break-in of the worm";
  return first ? "forward break-in of the gear" : "backward break-in of the gear";
}

}  // namespace wormdrive
