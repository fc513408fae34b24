#pragma once
#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/place.hpp"
#include "core/portable.hpp"
#include "core/sliding_contact.hpp"

namespace wormdrive {

/// Friction falls with the sliding speed v of the teeth as the lubricant parts them [Stribeck 1902]:
/// mu - drop (1 - exp(-(|v|/speed)^exponent)), where mu is the value at rest.
template <class T>
struct Stribeck {
  static constexpr std::string_view id = "stribeck";
  static constexpr Place place = Place::mesh;
  static constexpr std::string_view cause = "the lubricant parts the teeth the more the faster they slide";
  static constexpr std::string_view law =
      "mu - drop (1 - exp(-(|v|/speed)^exponent)) over the sliding speed v = lw theta_w'/cos(lambda); mu is the value "
      "at rest";
  static constexpr std::string_view source = "R. Stribeck, Z. VDI 46 (1902)";
  T drop{};
  T speed{};
  T exponent{1};

  static constexpr auto fields() {
    return std::tuple{
        Field{&Stribeck::drop, "drop", unit::none, bounds::any, "friction at rest less friction at high speed"},
        Field{&Stribeck::speed, "speed", unit::metre_per_second, bounds::positive,
              "sliding speed by which 63 % of the drop are reached"},
        Field{&Stribeck::exponent, "exponent", unit::none, bounds::between(1, 4),
              "shape of the fall, 1 exponential, 2 a bell; a whole number", Presence::optional}};
  }
  /// Coefficient of friction out of that without this effect.
  template <class S>
  S friction(const S& mu, const SlidingContact<S>& at) const {
    using portable::exp;
    // |v| by the sign of the motion: smooth where an integrator looks beyond a reversal, and bounded beyond that
    S x = T(sign(at.motion)) * at.sliding_speed / speed;
    if (x < S(T(-1))) x = S(T(-1));
    S power = x;
    for (int k = 1; k < exponent; ++k) power = power * x;
    return mu - drop * (S(T(1)) - exp(-power));
  }
  FrictionRange friction_range(const FrictionRange& mu, double) const {
    return {mu.low - std::max(0.0, drop), mu.high - std::min(0.0, drop)};
  }
};

}  // namespace wormdrive
