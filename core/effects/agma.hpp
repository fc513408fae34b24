#pragma once
#include <cstddef>
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
/// The standard's fit jumps at rest and at 0.0508 m/s; cubics with its values and slopes, within 0.06 % of it, join
/// the parts.
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
    return std::tuple{Field{&Agma::scale, "scale", unit::none, bounds::positive,
                            "factor on the friction of the standard", Presence::optional}};
  }
  /// The standard's coefficient of friction at a sliding speed v > 0 [m/s].
  static double standard(double v) { return fit_at(v).value(v / foot_per_minute); }
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
  static constexpr double at_rest = 0.150, foot_per_minute = 0.00508;  // [m/s]
  /// A part of the standard's fit, over the sliding speed V [ft/min].
  struct Fit {
    double factor, decay, exponent, least;
    double value(double V) const { return factor * portable::exp(-decay * portable::pow(V, exponent)) + least; }
    double slope(double V) const {
      return (value(V) - least) * -decay * exponent * portable::pow(V, exponent - 1.0);  // [min/ft]
    }
  };
  static Fit fit_at(double v) {
    return v / foot_per_minute > 10.0 ? Fit{0.103, 0.110, 0.450, 0.012} : Fit{0.124, 0.074, 0.645, 0.0};
  }
  /// Values and slopes of the standard at few points: a run stops at each that the speed passes.
  static const CubicTable& table() {
    static const CubicTable made = [] {
      const std::vector<double> v{
          0.0,  0.001, 0.002, 0.005, 0.01, 0.02, 0.03, 0.0508,  // 10 ft/min, where the fit changes
          0.06, 0.1,   0.2,   0.3,   0.5,  0.75, 1.0,  1.5,    2.0, 3.0,
          4.0,  5.0,   7.5,   10.0,  15.0, 20.0, 30.0, 50.0,   80.0};
      std::vector<double> mu{at_rest}, slope{0.0};  // at rest the standard states a value and no slope
      for (std::size_t k = 1; k < v.size(); ++k) {
        mu.push_back(standard(v[k]));
        slope.push_back(fit_at(v[k]).slope(v[k] / foot_per_minute) / foot_per_minute);
      }
      return CubicTable(v, mu, slope);
    }();
    return made;
  }
};

}  // namespace wormdrive
