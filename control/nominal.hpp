#pragma once
#include <optional>
#include <tuple>

#include "core/field.hpp"
#include "core/mode.hpp"
#include "core/numbers/sine_cosine.hpp"

namespace wormdrive {

/// What a controller believes about the drive, as far as it is stated; the rest is what the drive really is.
struct NominalSettings {
  std::optional<double> C1, C2, Jw_i, Jg, load_torque, load_angle_offset, load_constant;

  static constexpr auto fields() {
    using P = NominalSettings;
    constexpr Presence o = Presence::optional;
    return std::tuple{Field{&P::C1, "C1", unit::none, bounds::any, "estimate of C1; that of the mesh if not stated", o},
                      Field{&P::C2, "C2", unit::none, bounds::any, "estimate of C2; that of the mesh if not stated", o},
                      Field{&P::Jw_i, "worm_inertia_times_ratio", unit::kilogram_square_metre, bounds::positive,
                            "estimate of Jw i; that of the drive if not stated", o},
                      Field{&P::Jg, "gear_inertia", unit::kilogram_square_metre, bounds::positive,
                            "estimate of the gear-side inertia with the load; that of the drive if not stated", o},
                      Field{&P::load_torque, "load_torque", unit::newton_metre, bounds::any,
                            "amplitude of the estimated gravity load; that of the drive if not stated", o},
                      Field{&P::load_angle_offset, "load_angle_offset", unit::degrees, bounds::any,
                            "angle offset of the estimated gravity load; that of the drive if not stated", o},
                      Field{&P::load_constant, "load_constant", unit::newton_metre, bounds::any,
                            "constant part of the estimated load; that of the drive if not stated", o}};
  }
};

/// What a controller believes about the drive [YehWu2009, section 4]; its load estimate is
/// tau_l_hat = load_torque cos(theta_g + load_angle_offset) + load_constant.
struct NominalModel {
  double C1{}, C2{};
  double Jw_i{};                  ///< Jw i [kg m^2]
  double Jg{};                    ///< gear-side inertia with the load [kg m^2]
  double load_torque{0.0};        ///< [N m]
  double load_angle_offset{0.0};  ///< [rad]
  double load_constant{0.0};      ///< [N m]

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

/// The inertia that a linear design sees: the mean of both branches [kg m^2].
inline double mean_inertia(const NominalModel& nominal) {
  return 0.5 * (nominal.inertia(nominal.C1) + nominal.inertia(nominal.C2));
}

/// The stated beliefs, completed by what the drive really is.
inline NominalModel completed(const NominalSettings& stated, const NominalModel& drive) {
  return {stated.C1.value_or(drive.C1),
          stated.C2.value_or(drive.C2),
          stated.Jw_i.value_or(drive.Jw_i),
          stated.Jg.value_or(drive.Jg),
          stated.load_torque.value_or(drive.load_torque),
          stated.load_angle_offset.value_or(drive.load_angle_offset),
          stated.load_constant.value_or(drive.load_constant)};
}

}  // namespace wormdrive
