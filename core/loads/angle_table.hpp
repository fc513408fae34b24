#pragma once
#include <limits>
#include <string_view>
#include <vector>

#include "core/moment.hpp"
#include "core/numbers/cubic_table.hpp"

namespace wormdrive {

/// Load torques over strictly increasing gear angles, at least four.
struct AngleTable {
  static constexpr std::string_view kind = "angle_table";
  static constexpr std::string_view meaning = "table of load torque over gear angle, smooth between its points";
  std::vector<double> angles;   ///< [rad]
  std::vector<double> torques;  ///< [N m], as many as angles
};

/// The table as the equations use it: monotone cubic between the points, the end values beyond them.
struct TableLoad {
  CubicTable table;

  explicit TableLoad(const AngleTable& stated) : table(stated.angles, stated.torques) {}

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
