#pragma once
#include <limits>
#include <string_view>
#include <utility>
#include <vector>

#include "core/moment.hpp"
#include "core/numbers/cubic_table.hpp"
#include "core/table_columns.hpp"

namespace wormdrive {

/// Load torques over gear angles: monotone cubic between the points, the end values beyond them.
struct AngleTable {
  static constexpr std::string_view kind = "angle_table";
  static constexpr std::string_view meaning = "table of load torque over gear angle, smooth between its points";
  CubicTable table;  ///< torques [N m] over angles [rad]

  AngleTable() = default;
  /// Angles [rad], strictly increasing and at least four, and as many torques [N m].
  AngleTable(std::vector<double> angles, std::vector<double> torques) : table(std::move(angles), std::move(torques)) {}

  static constexpr TableColumns columns() {
    return {{"angles", unit::degrees},
            {"torques", unit::newton_metre},
            {"gear_angle", unit::radian},
            {"load_torque", unit::newton_metre}};
  }

  double inertia() const { return 0.0; }
  void enter(double) {}
  double next_knot(double) const { return std::numeric_limits<double>::infinity(); }
  double fastest() const { return 0.0; }
  double ripple() const { return 1.0 / table.least_interval(); }

  /// Load torque tau_l [N m] at the present gear angle.
  template <class S>
  S torque(const Moment<S>& at) const {
    return table(at.theta_g);
  }
};

}  // namespace wormdrive
