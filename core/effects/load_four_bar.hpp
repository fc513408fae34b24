#pragma once
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/loads/varying_inertia.hpp"
#include "core/numbers/jet.hpp"
#include "core/numbers/portable.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// A crank on the gear swings a rocker by a coupler: the gear feels the inertia of the rocker as the square of the
/// rocker's angle per its own.
template <class T>
struct LoadFourBar {
  static constexpr std::string_view id = "load_four_bar";
  static constexpr Place place = Place::load;
  static constexpr std::string_view cause =
      "a crank on the gear swings a rocker, a wiper or a gate, whose inertia depends on the angle";
  static constexpr std::string_view law =
      "Jg + inertia psi'^2, and -inertia psi' psi'' theta_g'^2 on the gear, where psi is the angle of the rocker over "
      "p = theta_g + angle: the coupler joins the end of the crank, crank (cos p, sin p), with that of the rocker, "
      "(base, 0) + rocker (cos psi, sin psi)";
  static constexpr std::string_view source =
      "F. Pfeiffer, Einfuehrung in die Dynamik, 3rd ed., Springer Vieweg 2014, chapter 2";
  T inertia{};
  T crank{};
  T coupler{};
  T rocker{};
  T base{};
  T shift{0.0};

  static constexpr auto fields() {
    using P = LoadFourBar;
    return std::tuple{Field{&P::inertia, "inertia", unit::kilogram_square_metre, bounds::not_negative,
                            "of the rocker and all that swings with it, about its pivot"},
                      Field{&P::crank, "crank", unit::metre, bounds::positive, "length of the crank on the gear"},
                      Field{&P::coupler, "coupler", unit::metre, bounds::positive, "length of the coupler"},
                      Field{&P::rocker, "rocker", unit::metre, bounds::positive, "length of the rocker"},
                      Field{&P::base, "base", unit::metre, bounds::positive, "from the gear's axis to the rocker's"},
                      Field{&P::shift, "angle", unit::degrees, bounds::any,
                            "crank angle from the direction of the rocker's axis at theta_g = 0", Presence::optional}};
  }

  /// How far, as a share of the crank, coupler and rocker have to stay from one line, where the crank would jam.
  static constexpr double least_clearance = 0.01;
  /// How far they stay from it [m]; less than 0 where the crank does not come round.
  double clearance() const {
    const double a = value_of(crank), b = value_of(coupler), c = value_of(rocker), d = value_of(base);
    return std::min(b + c - (a + d), std::abs(a - d) - std::abs(b - c));
  }

  /// What the gear feels of the rocker.
  template <class S>
  VaryingInertia<S> inertia_at(const S& theta_g) const {
    const Rocker<S> psi = rocker_at(theta_g);
    return {inertia * psi.slope * psi.slope, S(T(2) * inertia * psi.slope * psi.curvature)};
  }
  /// The greatest inertia that the gear feels [kg m^2].
  double greatest_inertia() const { return greatest_inertia_within(*this, 2.0 * std::numbers::pi); }
  /// Highest number of periods per radian of the gear: faster than once a turn where coupler and rocker come near one
  /// line, by the share in which the triangle of them changes per angle.
  double ripple(double) const {
    if (inertia == T(0)) return 0.0;
    constexpr int angles = 512;  // of the crank: as near as the least clearance it takes 0.1 rad through its turn
    double most = 2.0;
    for (int k = 0; k < angles; ++k) {
      const Rocker<T> at = rocker_at(T(2.0 * std::numbers::pi * k / angles));
      most = std::max(most, std::abs(value_of(at.area_rate) / value_of(at.area)));
    }
    return most;
  }

 private:
  /// The rocker's angle over the gear's: its slope and curvature. area: of the triangle of coupler, rocker and what
  /// lies between their ends, twice [m^2], and its rate over the angle.
  template <class S>
  struct Rocker {
    S slope, curvature, area, area_rate;
  };

  template <class S>
  Rocker<S> rocker_at(const S& theta_g) const {
    using portable::cos, portable::sin, std::sqrt;
    const S p = theta_g + shift, x = crank * cos(p), y = crank * sin(p);  // the end of the crank
    const S dx = x - base, dy = y;                                        // from the rocker's pivot
    const S square = dx * dx + dy * dy, square_rate = T(2) * base * y;
    const S m = T(0.5) * (square + (rocker * rocker - coupler * coupler));
    const S q = sqrt(rocker * rocker * square - m * m), q_rate = T(0.5) * square_rate * (rocker * rocker - m) / q;
    const S ux = (m * dx - q * dy) / square, uy = (m * dy + q * dx) / square;  // the rocker
    const S cx = ux - dx, cy = uy - dy;                                        // the coupler
    const S slope = (cy * x - cx * y) / q;
    const S cx_rate = y - slope * uy, cy_rate = slope * ux - x;
    const S curvature = (cy_rate * x - cx_rate * y - cx * x - cy * y - slope * q_rate) / q;
    return {slope, curvature, q, q_rate};
  }
};

}  // namespace wormdrive
