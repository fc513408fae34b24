#pragma once
#include "core/mode.hpp"
#include "core/moment.hpp"
#include "core/observation.hpp"

namespace wormdrive {

enum class Shaft { worm, gear };

/// The discrete state of the compliant drive: where the teeth touch and how each shaft moves.
struct CompliantMode {
  Flank contact = Flank::none;  ///< none: free in the gap
  /// A shaft on which no dry friction acts is never stuck, and its direction changes nothing: it is forward throughout.
  Motion worm = Motion::stuck, gear = Motion::stuck;

  constexpr Motion operator[](Shaft shaft) const { return shaft == Shaft::worm ? worm : gear; }
  constexpr CompliantMode with(Shaft shaft, Motion motion) const {
    return shaft == Shaft::worm ? CompliantMode{contact, motion, gear} : CompliantMode{contact, worm, motion};
  }
  /// As the rigid drive would call it: the motion of the worm, on which the friction of the teeth acts.
  constexpr operator Mode() const { return {worm, contact}; }  // NOLINT(google-explicit-constructor): for reports
  friend constexpr bool operator==(const CompliantMode&, const CompliantMode&) = default;
};

/// A moment of two bodies: beside the gear's angle and both speeds the worm's angle [rad].
template <class S>
struct TwoBodyMoment : Moment<S> {
  S theta_w;
};

/// What a compliant drive shows at one instant, in SI.
struct CompliantObservation : Observation {
  double theta_w;     ///< worm angle [rad]
  double omega_w;     ///< worm speed [rad/s]
  double alpha_w;     ///< worm acceleration [rad/s^2]
  double deflection;  ///< by how much the gear is ahead of the worm, theta_g - theta_w / i [rad]
  double friction;    ///< Wf [N]
};

}  // namespace wormdrive
