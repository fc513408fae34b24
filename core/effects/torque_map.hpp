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

/// Of what a torque map is a function.
enum class MapAxis { worm_speed, gear_angle, time };
/// Which shaft a torque map turns.
enum class MapShaft { worm, gear };

/// A torque on a shaft as a table gives it: what data show and no law explains.
template <class T>
struct TorqueMap {
  static constexpr std::string_view id = "torque_map";
  static constexpr Place place = Place::worm_shaft;
  static constexpr std::string_view cause = "a torque that data show and that no other effect explains";
  static constexpr std::string_view law =
      "scale table(theta_w'), scale table(theta_g) or scale table(t), on the worm or on the gear";
  MapAxis over = MapAxis::worm_speed;
  T scale{1.0};
  CubicTable table;  ///< torques [N m] over speeds [rad/s], angles [rad] or times [s]
  MapShaft shaft = MapShaft::worm;

  static constexpr auto fields() {
    return std::tuple{Field{&TorqueMap::scale, "scale", unit::none, bounds::any, "factor on all torques of the table",
                            Presence::optional}};
  }
  static constexpr auto choices() {
    return std::tuple{
        Choice{&TorqueMap::over, "over", std::array<std::string_view, 3>{"worm_speed", "gear_angle", "time"},
               "quantity on which the torque depends"},
        Choice{&TorqueMap::shaft, "shaft", std::array<std::string_view, 2>{"worm", "gear"},
               "shaft on which the torque acts"}};
  }
  TableColumns columns() const {
    constexpr ColumnName torques{"torques", unit::newton_metre}, torque{"torque", unit::newton_metre};
    switch (over) {
      case MapAxis::worm_speed:
        return {{"speeds", unit::radian_per_second}, torques, {"worm_speed", unit::radian_per_second}, torque};
      case MapAxis::gear_angle: return {{"angles", unit::degrees}, torques, {"gear_angle", unit::radian}, torque};
      case MapAxis::time: return {{"times", unit::second}, torques, {"time", unit::second}, torque};
    }
    return {};
  }
  /// Takes the table of the same effect with another scalar.
  template <class U>
  void take_table(const TorqueMap<U>& other) {
    over = other.over;
    table = other.table;
    shaft = other.shaft;
  }

  double ripple(double) const { return over == MapAxis::gear_angle ? 1.0 / table.least_interval() : 0.0; }
  double fastest_in_time() const { return over == MapAxis::time ? 1.0 / table.least_interval() : 0.0; }
  /// Torque on the worm shaft [N m] ...
  template <class S>
  S worm_torque(const Moment<S>& at, Motion) const {
    return shaft == MapShaft::worm ? torque(at) : S(0.0);
  }
  /// ... and on the gear shaft [N m].
  template <class S>
  S gear_torque(const Moment<S>& at, Motion) const {
    return shaft == MapShaft::gear ? torque(at) : S(0.0);
  }

 private:
  template <class S>
  S torque(const Moment<S>& at) const {
    switch (over) {
      case MapAxis::worm_speed: return scale * table(at.omega_w);
      case MapAxis::gear_angle: return scale * table(at.theta_g);
      case MapAxis::time: return scale * table(at.t);
    }
    return S(0.0);
  }
};

}  // namespace wormdrive
