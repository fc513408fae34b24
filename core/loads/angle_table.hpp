#pragma once
#include <algorithm>
#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

// clang-format off: pchip of boost 1.74 uses isnan and forgets to include it
#include <boost/math/special_functions/fpclassify.hpp>
#include <boost/math/interpolators/pchip.hpp>
// clang-format on

#include "core/moment.hpp"

namespace wormdrive {

/// Load torques over strictly increasing gear angles, at least four.
struct AngleTable {
  static constexpr std::string_view kind = "angle_table";
  static constexpr std::string_view meaning = "table of load torque over gear angle, smooth between its points";
  std::vector<double> angles;   ///< [rad]
  std::vector<double> torques;  ///< [N m], as many as angles
};

/// The table as the equations use it: monotone cubic between the points, the end values beyond them.
class TableLoad {
 public:
  explicit TableLoad(const AngleTable& table) : angles_(table.angles), torques_(table.torques) {
    const boost::math::interpolators::pchip<std::vector<double>> spline(std::vector<double>(angles_),
                                                                        std::vector<double>(torques_), 0.0, 0.0);
    for (double angle : angles_) slopes_.push_back(spline.prime(angle));
  }

  double inertia() const { return 0.0; }
  void enter(double) {}
  double next_knot(double) const { return std::numeric_limits<double>::infinity(); }
  double fastest() const { return 0.0; }

  /// Load torque tau_l [N m] at the present gear angle.
  template <class S>
  S torque(const Moment<S>& at) const {
    if (at.theta_g <= S(angles_.front())) return S(torques_.front());
    if (at.theta_g >= S(angles_.back())) return S(torques_.back());
    const std::size_t k = interval(at.theta_g);
    const double h = angles_[k + 1] - angles_[k];
    const double rise = (torques_[k + 1] - torques_[k]) / h;
    const double second = (3.0 * rise - 2.0 * slopes_[k] - slopes_[k + 1]) / h;
    const double third = (slopes_[k] + slopes_[k + 1] - 2.0 * rise) / (h * h);
    const S x = at.theta_g - angles_[k];
    return torques_[k] + x * (slopes_[k] + x * (second + x * third));
  }

 private:
  template <class S>
  std::size_t interval(const S& theta_g) const {
    const auto after = std::upper_bound(angles_.begin(), angles_.end(), theta_g,
                                        [](const S& x, double angle) { return x < S(angle); });
    return static_cast<std::size_t>(after - angles_.begin()) - 1;
  }
  std::vector<double> angles_, torques_, slopes_;
};

}  // namespace wormdrive
