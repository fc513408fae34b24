#pragma once
#include <algorithm>
#include <cmath>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/field.hpp"
#include "core/numbers/cubic_table.hpp"
#include "core/numbers/portable.hpp"
#include "core/place.hpp"
#include "core/sliding_contact.hpp"

namespace wormdrive {

/// Friction over the sliding speed after ANSI/AGMA 6034-B92, in place of the mesh's own: 0.150 at rest and falling.
///
/// The standard's fit jumps at rest and at 0.0508 m/s; a monotone cubic through its values joins the parts.
template <class T>
struct Agma {
  static constexpr std::string_view id = "agma";
  static constexpr Place place = Place::mesh;
  static constexpr std::string_view cause =
      "friction falls with the sliding speed as for a steel worm in a bronze gear with mineral oil";
  static constexpr std::string_view law =
      "scale times the fit of the standard over the sliding speed, whatever the mesh states; 0.150 at rest";
  static constexpr std::string_view source = "ANSI/AGMA 6034-B92";
  static constexpr Exclusion excludes[] = {{"stribeck", "both say how friction falls with the sliding speed"}};
  T scale{1};

  static constexpr auto fields() {
    return std::tuple{Field{&Agma::scale, "scale", unit::none, bounds::positive, "share of the standard's friction",
                            Presence::optional}};
  }
  /// The standard's coefficient of friction at a sliding speed v > 0 [m/s].
  static double standard(double v) {
    const double V = v / 0.00508;  // [ft/min]
    return V > 10.0 ? 0.103 * portable::exp(-0.110 * portable::pow(V, 0.450)) + 0.012
                    : 0.124 * portable::exp(-0.074 * portable::pow(V, 0.645));
  }
  /// Coefficient of friction, whatever that of the mesh is.
  template <class S>
  S friction(const S&, const SlidingContact<S>& at) const {
    return scale * table()(T(sign(at.motion)) * at.sliding_speed);
  }
  FrictionRange friction_range(const FrictionRange&, double) const {
    const double share = static_cast<double>(scale);
    return {share * table().values().back(), share * at_rest};
  }

 private:
  static constexpr double at_rest = 0.150;
  static const CubicTable& table() {
    static const CubicTable made = [] {
      std::vector<double> v{0.0508}, mu{at_rest};  // 10 ft/min, where the fit changes
      for (const double decade : {0.001, 0.01, 0.1, 1.0, 10.0})
        for (const double step : {1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 6.0, 8.0}) v.push_back(decade * step);
      std::sort(v.begin(), v.end());
      for (const double speed : v) mu.push_back(standard(speed));
      v.insert(v.begin(), 0.0);
      return CubicTable(v, mu);
    }();
    return made;
  }
};

}  // namespace wormdrive
