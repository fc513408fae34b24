#pragma once
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/place.hpp"
#include "core/sliding_contact.hpp"

namespace wormdrive {

/// The teeth rub more, or less, than stated: mu + change.
template <class T>
struct MeshFriction {
  static constexpr std::string_view id = "mesh_friction";
  static constexpr Place place = Place::mesh;
  static constexpr std::string_view cause =
      "lubrication, temperature, wear or the finish of the teeth is not what was assumed";
  static constexpr std::string_view law = "mu + change";
  T change{};

  static constexpr auto fields() {
    return std::tuple{Field{&MeshFriction::change, "change", unit::none, bounds::any,
                            "coefficient of friction in addition to that of the mesh"}};
  }
  /// Coefficient of friction out of that without this effect.
  template <class S>
  S friction(const S& mu, const SlidingContact<S>&) const {
    return mu + change;
  }
  FrictionRange friction_range(const FrictionRange& mu, double) const { return {mu.low + change, mu.high + change}; }
};

}  // namespace wormdrive
