#pragma once
#include <algorithm>
#include <array>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/numbers/cubic_table.hpp"
#include "core/place.hpp"
#include "core/sliding_contact.hpp"
#include "core/table_columns.hpp"

namespace wormdrive {

/// Of what the friction between the teeth is a function.
enum class FrictionAxis { sliding_speed, gear_angle, time };
/// What a table of friction gives.
enum class FrictionValue { share, coefficient };

/// Friction between the teeth as a table gives it: a law that was measured, or what data show and no law explains.
template <class T>
struct FrictionMap {
  static constexpr std::string_view id = "friction_map";
  static constexpr Place place = Place::mesh;
  static constexpr std::string_view cause =
      "friction that was measured, or that data show and that no other effect explains";
  static constexpr std::string_view law =
      "mu (1 + scale table(v)), of shares, or scale table(v) in place of mu, of coefficients; v is abs(sliding speed), "
      "theta_g or t";
  FrictionAxis over = FrictionAxis::sliding_speed;
  FrictionValue gives = FrictionValue::share;
  T scale{1.0};
  CubicTable table;  ///< shares or coefficients over speeds [m/s], angles [rad] or times [s]

  static constexpr auto fields() {
    return std::tuple{Field{&FrictionMap::scale, "scale", unit::none, bounds::any, "factor on all values of the table",
                            Presence::optional}};
  }
  static constexpr auto choices() {
    return std::tuple{
        Choice{&FrictionMap::over, "over", std::array<std::string_view, 3>{"sliding_speed", "gear_angle", "time"},
               "quantity on which the friction depends"},
        Choice{&FrictionMap::gives, "gives", std::array<std::string_view, 2>{"share", "coefficient"},
               "whether the table gives changes as shares of the mesh's friction, or coefficients in place of it"}};
  }
  TableColumns columns() const {
    const bool of_shares = gives == FrictionValue::share;
    const ColumnName values{of_shares ? "shares" : "coefficients", unit::none},
        value{of_shares ? "share" : "coefficient", unit::none};
    switch (over) {
      case FrictionAxis::sliding_speed:
        return {{"sliding_speeds", unit::metre_per_second}, values, {"sliding_speed", unit::metre_per_second}, value};
      case FrictionAxis::gear_angle: return {{"angles", unit::degrees}, values, {"gear_angle", unit::radian}, value};
      case FrictionAxis::time: return {{"times", unit::second}, values, {"time", unit::second}, value};
    }
    return {};
  }
  /// Takes the table of the same effect with another scalar.
  template <class U>
  void take_table(const FrictionMap<U>& other) {
    over = other.over;
    gives = other.gives;
    table = other.table;
  }

  double ripple(double) const { return over == FrictionAxis::gear_angle ? 1.0 / table.least_interval() : 0.0; }
  double fastest_in_time() const { return over == FrictionAxis::time ? 1.0 / table.least_interval() : 0.0; }
  /// Coefficient of friction out of that without this effect.
  template <class S>
  S friction(const S& mu, const SlidingContact<S>& at) const {
    const S value = scale * table(argument(at));
    return gives == FrictionValue::share ? mu + mu * value : value;
  }
  FrictionRange friction_range(const FrictionRange& mu, double) const {
    if (table.values().empty()) return mu;
    const auto [least, most] = std::minmax_element(table.values().begin(), table.values().end());
    const double factor = static_cast<double>(scale), one = factor * *least, other = factor * *most;
    const double low = std::min(one, other), high = std::max(one, other);
    if (gives == FrictionValue::coefficient) return {low, high};
    return {mu.low * (1.0 + low), mu.high * (1.0 + high)};
  }

 private:
  template <class S>
  S argument(const SlidingContact<S>& at) const {
    switch (over) {
      case FrictionAxis::sliding_speed: return T(sign(at.motion)) * at.sliding_speed;
      case FrictionAxis::gear_angle: return at.theta_g;
      case FrictionAxis::time: return at.t;
    }
    return at.t;
  }
};

}  // namespace wormdrive
