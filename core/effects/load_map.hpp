#pragma once
#include <array>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/numbers/cubic_table.hpp"
#include "core/place.hpp"
#include "core/table_columns.hpp"

namespace wormdrive {

/// Of what the load's change is a function.
enum class LoadAxis { time, gear_angle };

/// The load torque changes by a share that a table gives: a payload that is taken off or up, or what data show.
template <class T>
struct LoadMap {
  static constexpr std::string_view id = "load_map";
  static constexpr Place place = Place::load;
  static constexpr std::string_view cause = "a load that changes, or that differs in the data from the stated one";
  static constexpr std::string_view law = "(1 + scale table(t)) tau_l or (1 + scale table(theta_g)) tau_l";
  LoadAxis over = LoadAxis::time;
  T scale{1.0};
  CubicTable table;  ///< shares over times [s] or angles [rad]

  static constexpr auto fields() {
    return std::tuple{Field{&LoadMap::scale, "scale", unit::none, bounds::any, "factor on all shares of the table",
                            Presence::optional}};
  }
  static constexpr auto choices() {
    return std::tuple{Choice{&LoadMap::over, "over", std::array<std::string_view, 2>{"time", "gear_angle"},
                             "quantity on which the change of the load depends"}};
  }
  TableColumns columns() const {
    constexpr ColumnName shares{"shares", unit::none}, share{"share", unit::none};
    if (over == LoadAxis::time) return {{"times", unit::second}, shares, {"time", unit::second}, share};
    return {{"angles", unit::degrees}, shares, {"gear_angle", unit::radian}, share};
  }
  /// Takes the table of the same effect with another scalar.
  template <class U>
  void take_table(const LoadMap<U>& other) {
    over = other.over;
    table = other.table;
  }

  double ripple(double) const { return over == LoadAxis::gear_angle ? 1.0 / table.least_interval() : 0.0; }
  double fastest_in_time() const { return over == LoadAxis::time ? 1.0 / table.least_interval() : 0.0; }
  /// Load torque [N m] out of that without this effect.
  template <class S>
  S load_torque(const S& torque, const Moment<S>& at) const {
    return torque + scale * table(over == LoadAxis::time ? at.t : at.theta_g) * torque;
  }
};

}  // namespace wormdrive
