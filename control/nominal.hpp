#pragma once
#include <tuple>

#include "core/field.hpp"
#include "core/mode.hpp"
#include "core/sine_cosine.hpp"

namespace wormdrive {

/// What a controller believes about the drive [YehWu2009, section 4]; its load estimate is
/// tau_l_hat = load_torque cos(theta_g + load_angle_offset) + load_constant.
struct NominalModel {
  double C1{}, C2{};
  double Jw_i{};  ///< Jw i [kg m^2]
  double Jg{};    ///< gear-side inertia with the load [kg m^2]
  double load_torque{0.0};
  double load_angle_offset{0.0};
  double load_constant{0.0};

  static constexpr auto fields() {
    using P = NominalModel;
    constexpr Presence o = Presence::optional;
    return std::tuple{
        Field{&P::C1, "C1", unit::none, bounds::any, "estimate of C1; that of the mesh if not stated", o},
        Field{&P::C2, "C2", unit::none, bounds::any, "estimate of C2; that of the mesh if not stated", o},
        Field{&P::Jw_i, "worm_inertia_times_ratio", unit::kilogram_square_metre, bounds::positive,
              "estimate of Jw i; that of the drive if not stated", o},
        Field{&P::Jg, "gear_inertia", unit::kilogram_square_metre, bounds::positive,
              "estimate of the gear-side inertia with the load; that of the drive if not stated", o},
        Field{&P::load_torque, "load_torque", unit::newton_metre, bounds::any,
              "amplitude of the estimated gravity load; that of the drive if not stated", o},
        Field{&P::load_angle_offset, "load_angle_offset", unit::degrees, bounds::any,
              "angle offset of the estimated gravity load; that of the drive if not stated", o},
        Field{&P::load_constant, "load_constant", unit::newton_metre, bounds::any, "constant part of the estimated load",
              o}};
  }

  /// Slope of the switching surface, Jw i / Jg.
  double surface() const { return Jw_i / Jg; }
  double load(double theta_g) const {
    return load_torque * sine_and_cosine(theta_g + load_angle_offset).cosine + load_constant;
  }
  /// C of the branch u < 0 (left flank) or u > 0 (right flank) for a direction of motion [YehWu2009, eq. 20].
  double C(Motion motion, Flank flank) const { return sign(motion) * sign(flank) > 0 ? C1 : C2; }
  /// Inertia of a branch, Jw i + C Jg = 1/b_hat.
  double inertia(double C) const { return Jw_i + C * Jg; }
};

}  // namespace wormdrive
