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
      "a flange, a shaft or a payload on the gear shaft, or a gear other than stated";
  static constexpr std::string_view law = "Jg + inertia";
  T inertia{};

  static constexpr auto fields() {
    return std::tuple{Field{&GearInertia::inertia, "inertia", unit::kilogram_square_metre, bounds::any,
                            "what the gear side has beside what the mesh states"}};
  }
  /// Inertia on the gear shaft [kg m^2].
  T gear_inertia() const { return inertia; }
};

}  // namespace wormdrive
