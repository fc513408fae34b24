#pragma once
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/loads/varying_inertia.hpp"
#include "core/numbers/jet.hpp"
#include "core/numbers/portable.hpp"
#include "core/place.hpp"

namespace wormdrive {

/// A crank on the gear pushes a mass to and fro, by a connecting rod or without one in a slot (Scotch yoke): the gear
/// feels the inertia of the mass as the square of the way per angle.
template <class T>
struct LoadCrank {
  static constexpr std::string_view id = "load_crank";
  static constexpr Place place = Place::load;
  static constexpr std::string_view cause =
      "a crank on the gear moves a slide, a piston or a press, whose inertia depends on the angle";
  static constexpr std::string_view law =
      "Jg + mass x'^2, and -mass x' x'' theta_g'^2 on the gear, with x = crank cos p + sqrt(rod^2 - crank^2 sin(p)^2) "
      "over p = theta_g + angle; x = crank cos p without a rod";
  static constexpr std::string_view source =
      "F. Pfeiffer, Einfuehrung in die Dynamik, 3rd ed., Springer Vieweg 2014, chapter 2";
  T mass{};
  T crank{};
  std::optional<T> rod{};
  T shift{0.0};

  static constexpr auto fields() {
    using P = LoadCrank;
    return std::tuple{
        Field{&P::mass, "mass", unit::kilogram, bounds::not_negative, "reciprocating mass"},
        Field{&P::crank, "crank", unit::metre, bounds::positive, "radius of the crank"},
        Field{&P::rod, "rod", unit::metre, bounds::positive,
              "length of the connecting rod, at least 1.01 times the crank; without one the mass is in a slot",
              Presence::optional},
        Field{&P::shift, "angle", unit::degrees, bounds::any, "crank angle from the outer dead centre at theta_g = 0",
              Presence::optional}};
  }

  /// How many times as long as the crank a rod has to be: a shorter one stands within 8 degrees of across its way,
  /// where no guide lets it through, and hurls the mass through its turn within as little of the gear's.
  static constexpr double shortest_rod = 1.01;

  /// What the gear feels of the mass.
  template <class S>
  VaryingInertia<S> inertia_at(const S& theta_g) const {
    using portable::cos, portable::sin, std::sqrt;
    const S p = theta_g + shift, sine = sin(p), cosine = cos(p);
    S way = -crank * sine, bend = -crank * cosine;  // x' and x''
    if (rod) {
      const S tilt = crank * sine, height = sqrt(*rod * *rod - tilt * tilt);  // of the rod along the way
      const S push = crank * cosine / height;
      way = way - tilt * push;
      bend = bend - push * crank * cosine + tilt * tilt / height * (S(T(1)) - push * push);
    }
    return {mass * way * way, S(T(2) * mass * way * bend)};
  }
  /// The greatest inertia that the gear feels [kg m^2], between the dead centres.
  double greatest_inertia() const {
    LoadCrank from_dead_centre = *this;
    from_dead_centre.shift = T(0.0);
    return greatest_inertia_within(from_dead_centre, std::numbers::pi);
  }
  /// Highest number of periods per radian of the gear: twice a turn, and faster where the rod is hardly longer than the
  /// crank.
  double ripple(double) const {
    if (mass == T(0)) return 0.0;
    if (!rod) return 2.0;
    const double share = value_of(crank) / value_of(*rod);
    return 2.0 / std::sqrt(1.0 - share * share);
  }
};

}  // namespace wormdrive
