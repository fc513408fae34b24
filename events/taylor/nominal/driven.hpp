#pragma once
#include "events/taylor/nominal/leap.hpp"

namespace wormdrive {

/// A mode under a motor's command: theta'' = per_command command + ..., what else is held included.
template <class V>
struct DrivenMotionOf {
  HeldMotionOf<V> held;
  V per_command, gain;     ///< acceleration and motor torque of a command
  V per_worm_torque;       ///< acceleration of a torque on the worm's shaft
  HeldTorquesOf<V> known;  ///< what dry friction of the bearings and other constant torques do to the drive

  /// unit_gain: the gain is 1.
  template <bool unit_gain>
  [[gnu::always_inline]] HeldTorquesOf<V> under(const V& command) const {
    return {command * per_command + known.push, (unit_gain ? command : command * gain) + known.beyond};
  }
  /// The same with a torque that disturbs the worm's shaft.
  [[gnu::always_inline]] HeldTorquesOf<V> under(const V& command, const V& disturbance) const {
    return {command * per_command + (known.push + disturbance * per_worm_torque),
            command * gain + (known.beyond + disturbance)};
  }
  /// What a torque adds that is left over from the command before.
  [[gnu::always_inline]] HeldTorquesOf<V> of_decaying(const V& torque) const {
    return {torque * per_command, torque * gain};
  }
};
using DrivenMotion = DrivenMotionOf<double>;

}  // namespace wormdrive
