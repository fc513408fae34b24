#pragma once
#include <cmath>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/place.hpp"
#include "core/sliding_contact.hpp"

namespace wormdrive {

/// The teeth rub more forward than backward: mu + change sgn(theta_g').
template <class T>
struct FrictionAsymmetry {
  static constexpr std::string_view id = "friction_asymmetry";
  static constexpr Place place = Place::mesh;
  static constexpr std::string_view cause = "the flanks differ in finish or wear between the two directions";
  static constexpr std::string_view law = "mu + change sgn(theta_g')";
  T change{};

  static constexpr auto fields() {
    return std::tuple{Field{&FrictionAsymmetry::change, "change", unit::none, bounds::any,
                            "coefficient of friction above the mean forward, below it backward"}};
  }
  /// Coefficient of friction out of that without this effect.
  template <class S>
  S friction(const S& mu, const SlidingContact<S>& at) const {
    return mu + T(sign(at.motion)) * change;
  }
  FrictionRange friction_range(const FrictionRange& mu, double) const {
    return {mu.low - std::abs(change), mu.high + std::abs(change)};
  }
};

}  // namespace wormdrive
