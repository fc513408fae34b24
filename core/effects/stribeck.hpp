#pragma once
#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/numbers/portable.hpp"
#include "core/numbers/series.hpp"
#include "core/place.hpp"
#include "core/sliding_contact.hpp"

namespace wormdrive {

/// Friction falls with the sliding speed v of the teeth as the lubricant parts them [Stribeck 1902]: mu - drop (1 - e)
/// with x = (|v|/speed)^exponent and e = exp(-x) [Tustin 1947; Bo & Pavelescu 1982] or 1/(1 + x) [Hess & Soom 1990],
/// where mu is the value at rest.
template <class T>
struct Stribeck {
  static constexpr std::string_view id = "stribeck";
  static constexpr Place place = Place::mesh;
  static constexpr std::string_view cause = "the lubricant separates the teeth more, the faster they slide";
  static constexpr std::string_view law =
      "mu - drop (1 - e), e = exp(-x) or 1/(1 + x) with x = (|v|/speed)^exponent, over the sliding speed "
      "v = lw theta_w'/cos(lambda); mu is the value at rest";
  static constexpr std::string_view source =
      "R. Stribeck, Z. VDI 46 (1902); D. P. Hess, A. Soom, J. Tribology 112 (1990) 147-152";
  T drop{};
  T speed{};
  T exponent{1};
  T tail{0};

  static constexpr auto fields() {
    return std::tuple{
        Field{&Stribeck::drop, "drop", unit::none, bounds::any, "friction at rest less friction at high speed"},
        Field{&Stribeck::speed, "speed", unit::metre_per_second, bounds::positive,
              "sliding speed at which 63 % of the drop is reached, or 50 % with tail = 1"},
        Field{&Stribeck::exponent, "exponent", unit::whole, bounds::between(1, 4),
              "shape of the fall, 1 pointed, 2 a bell", Presence::optional},
        Field{&Stribeck::tail, "tail", unit::whole, bounds::between(0, 1),
              "end of the fall, 0 exponential, 1 as 1/(1 + x)", Presence::optional}};
  }
  /// Coefficient of friction out of that without this effect.
  template <class S>
  S friction(const S& mu, const SlidingContact<S>& at) const {
    using portable::exp;
    // |v| by the sign of the motion: smooth where an integrator looks beyond a reversal, and bounded beyond that
    const double least = tail > 0 ? -0.5 : -1.0;  // 1/(1 + x) has a pole at -1
    const S x = at_least(S(T(sign(at.motion)) * at.sliding_speed / speed), least);
    S power = x;
    for (int k = 1; k < exponent; ++k) power = power * x;
    const S one = S(T(1));
    return mu - drop * (tail > 0 ? power / (one + power) : one - exp(-power));
  }
  FrictionRange friction_range(const FrictionRange& mu, double) const {
    return {mu.low - std::max(0.0, drop), mu.high - std::min(0.0, drop)};
  }
};

}  // namespace wormdrive
