#pragma once
#include <algorithm>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/place.hpp"
#include "core/sliding_contact.hpp"

namespace wormdrive {

/// Friction changes in the course of the run: mu (1 + share t/time).
template <class T>
struct FrictionDrift {
  static constexpr std::string_view id = "friction_drift";
  static constexpr Place place = Place::mesh;
  static constexpr std::string_view cause = "the drive warms up, or its lubricant is used up, during the run";
  static constexpr std::string_view law = "mu (1 + share t/time)";
  T share{};
  T time{};

  static constexpr auto fields() {
    return std::tuple{Field{&FrictionDrift::share, "share", unit::none, bounds::any,
                            "change within the time, as a share of the friction at t = 0"},
                      Field{&FrictionDrift::time, "time", unit::second, bounds::positive,
                            "time within which friction changes by the share"}};
  }
  /// Coefficient of friction out of that without this effect.
  template <class S>
  S friction(const S& mu, const SlidingContact<S>& at) const {
    return mu + mu * (share / time * at.t);
  }
  FrictionRange friction_range(const FrictionRange& mu, double end) const {
    const double change = share * end / time;
    return {mu.low * (1.0 + std::min(0.0, change)), mu.high * (1.0 + std::max(0.0, change))};
  }
};

}  // namespace wormdrive
