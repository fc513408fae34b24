#pragma once
#include <cmath>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/numbers/portable.hpp"
#include "core/place.hpp"
#include "core/sliding_contact.hpp"

namespace wormdrive {

/// Teeth at rest hold more than sliding ones: mu + rise, with a growth time mu + rise (1 - exp(-rest/growth_time)),
/// where rest is how long the gear has been at rest [Coulomb 1785].
template <class T>
struct StaticFriction {
  static constexpr std::string_view id = "static_friction";
  static constexpr Place place = Place::mesh;
  static constexpr std::string_view cause =
      "at rest the teeth squeeze the lubricant out of the contact, more so with time";
  static constexpr std::string_view law =
      "at rest mu + rise (1 - exp(-rest/growth_time)), where rest is the time since the gear came to rest; mu + rise "
      "without a growth time";
  static constexpr std::string_view source = "E. Rabinowicz, J. Appl. Phys. 22 (1951) 1373";
  static constexpr Exclusion excludes[] = {{"tooth_compliance", "elastic teeth hold with the friction of sliding"}};
  T rise{};
  T growth_time{0};

  static constexpr auto fields() {
    return std::tuple{
        Field{&StaticFriction::rise, "rise", unit::none, bounds::not_negative,
              "coefficient of friction at break-away in addition to that of sliding"},
        Field{&StaticFriction::growth_time, "growth_time", unit::second, bounds::not_negative,
              "time at rest after which 63 % of the rise holds; with 0 all of it holds at once", Presence::optional}};
  }
  /// Coefficient of friction out of that without this effect.
  template <class S>
  S friction(const S& mu, const SlidingContact<S>& at) const {
    using portable::exp;
    if (at.rest < S(T(0))) return mu;
    return growth_time > T(0) ? mu + rise * (S(T(1)) - exp(-at.rest / growth_time)) : mu + S(rise);
  }
  FrictionRange friction_range(const FrictionRange& mu, double) const { return {mu.low, mu.high + rise}; }
  /// Highest angular frequency with which friction still changes after so long at rest [s], in rad/s.
  double fastest_at_rest(double rest) const {
    constexpr double grown = 37.0;  // what is left after so many growth times is less than a rounding
    const double time = static_cast<double>(growth_time);
    return time > 0.0 && rest < grown * time ? 1.0 / time : 0.0;
  }
};

}  // namespace wormdrive
