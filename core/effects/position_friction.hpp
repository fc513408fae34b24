#pragma once
#include <cmath>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/numbers/portable.hpp"
#include "core/place.hpp"
#include "core/sliding_contact.hpp"

namespace wormdrive {

/// Friction changes once per turn of the gear: mu (1 + amplitude sin(theta_g + phase)).
template <class T>
struct PositionFriction {
  static constexpr std::string_view id = "position_friction";
  static constexpr Place place = Place::mesh;
  static constexpr std::string_view cause = "the gear runs out of true, or its teeth are worn over a part of the turn";
  static constexpr std::string_view law = "mu (1 + amplitude sin(theta_g + phase))";
  T amplitude{};
  T phase{};

  static constexpr auto fields() {
    return std::tuple{Field{&PositionFriction::amplitude, "amplitude", unit::none, bounds::between(-1, 1),
                            "largest change as a share of the friction"},
                      Field{&PositionFriction::phase, "phase", unit::degrees, bounds::any, "phase at gear angle zero"}};
  }
  double ripple(double) const { return amplitude != T(0) ? 1.0 : 0.0; }
  /// Coefficient of friction out of that without this effect.
  template <class S>
  S friction(const S& mu, const SlidingContact<S>& at) const {
    using portable::sin;
    return mu + mu * (amplitude * sin(at.theta_g + phase));
  }
  FrictionRange friction_range(const FrictionRange& mu, double) const { return mu.spread(std::abs(amplitude)); }
};

}  // namespace wormdrive
