#pragma once
#include <string_view>

namespace wormdrive {

/// Where in the drive an effect acts.
enum class Place { actuator, worm_shaft, mesh, gear_shaft, load, sensor };

constexpr std::string_view name(Place place) {
  switch (place) {
    case Place::actuator: return "actuator";
    case Place::worm_shaft: return "worm shaft";
    case Place::mesh: return "mesh";
    case Place::gear_shaft: return "gear shaft";
    case Place::load: return "load";
    case Place::sensor: return "sensor";
  }
  return "";
}

/// Another effect with which an effect cannot be combined.
struct Exclusion {
  std::string_view id;   ///< of the other one
  std::string_view why;  ///< what both would say, or what one leaves out
};

}  // namespace wormdrive
