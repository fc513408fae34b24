#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// Inertia on the gear shaft in addition to that of the mesh.
template <class T>
struct GearInertia {
  static constexpr std::string_view id = "gear_inertia";
  static constexpr Place place = Place::gear_shaft;
  static constexpr std::string_view cause =
      "a flange, a shaft or a payload on the gear shaft, or another gear than the stated one";
  static constexpr std::string_view law = "Jg + inertia";
  T inertia{};

  static constexpr auto fields() {
    return std::tuple{Field{&GearInertia::inertia, "inertia", unit::kilogram_square_metre, bounds::any,
                            "inertia of the gear side in addition to that stated for the mesh"}};
  }
  /// Inertia on the gear shaft [kg m^2].
  T gear_inertia() const { return inertia; }
};

}  // namespace wormdrive
