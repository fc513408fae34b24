#pragma once
#include <optional>
#include <tuple>

#include "core/field.hpp"

namespace wormdrive {

/// How well the stated parameters of a drive are known: standard deviations, 0 for one that is exact. A diagnosis
/// names as a cause only what lies outside.
struct Tolerances {
  double friction{0.01};                  ///< share of the mesh's
  double load{0.01};                      ///< share of the load torque
  double load_angle{0.01};                ///< [rad]
  double worm_inertia{0.01};              ///< share
  double gear_inertia{0.01};              ///< share, the load's own included
  double torque_gain{0.01};               ///< share of the motor's torque
  std::optional<double> torque_offset{};  ///< [N m]; a hundredth of the recorded torque's rms if not stated

  static constexpr auto fields() {
    using P = Tolerances;
    constexpr Presence o = Presence::optional;
    constexpr Unit percent = unit::percent;
    constexpr Bounds b = bounds::not_negative;
    return std::tuple{
        Field{&P::friction, "friction", percent, b, "of the coefficient of friction between the teeth", o},
        Field{&P::load, "load", percent, b, "of the load torque, by mass, arm or force", o},
        Field{&P::load_angle, "load_angle", unit::degrees, b, "of the angle at which the load sits on the gear", o},
        Field{&P::worm_inertia, "worm_inertia", percent, b, "of the inertia of the worm side", o},
        Field{&P::gear_inertia, "gear_inertia", percent, b, "of the inertia of the gear side, the load's included", o},
        Field{&P::torque_gain, "torque_gain", percent, b, "of the motor's torque per command", o},
        Field{&P::torque_offset, "torque_offset", unit::newton_metre, b,
              "of the motor's torque at a command of zero; a hundredth of the recorded torque's rms if not stated", o}};
  }
};

}  // namespace wormdrive
