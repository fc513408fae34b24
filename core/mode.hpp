#pragma once
#include <cstdint>

namespace wormdrive {

/// Sign of the gear speed; a variable of its own, never derived from the speed's value.
enum class Motion : std::int8_t { backward = -1, stuck = 0, forward = 1 };

/// Which flank of the tooth carries the load [YehWu2009, section 2]; none while stuck or without a mesh.
enum class Flank : std::int8_t { right = -1, none = 0, left = 1 };

/// The direction of a speed, where no mode states it.
template <class S>
constexpr Motion motion_of(const S& speed) {
  const S rest(0.0);
  return speed > rest ? Motion::forward : speed < rest ? Motion::backward : Motion::stuck;
}
constexpr int sign(Motion motion) { return static_cast<int>(motion); }
constexpr int sign(Flank flank) { return static_cast<int>(flank); }

/// The discrete state of the rigid drive: it selects one of the four equations [YehWu2009, eq. 18-19], or rest.
struct Mode {
  Motion motion = Motion::stuck;
  Flank flank = Flank::none;

  /// +1 where C1 acts, -1 where C2 acts, 0 at rest.
  constexpr int product() const { return sign(motion) * sign(flank); }
  friend constexpr bool operator==(const Mode&, const Mode&) = default;
};

}  // namespace wormdrive
