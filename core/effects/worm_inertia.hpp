#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// Inertia on the worm shaft in addition to that of the mesh.
template <class T>
struct WormInertia {
  static constexpr std::string_view id = "worm_inertia";
  static constexpr Place place = Place::worm_shaft;
  static constexpr std::string_view cause =
      "a brake, a coupling or an encoder on the worm shaft, or another rotor than the stated one";
  static constexpr std::string_view law = "Jw + inertia";
  T inertia{};

  static constexpr auto fields() {
    return std::tuple{Field{&WormInertia::inertia, "inertia", unit::kilogram_square_metre, bounds::any,
                            "inertia of the worm side in addition to that stated for the mesh"}};
  }
  /// Inertia on the worm shaft [kg m^2].
  T worm_inertia() const { return inertia; }
};

}  // namespace wormdrive
