#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/mesh.hpp"
#include "core/mode.hpp"
#include "events/taylor/nominal/affine_motor.hpp"
#include "events/taylor/nominal/driven.hpp"
#include "events/taylor/nominal/stribeck.hpp"

namespace wormdrive {

/// What the terms of a sum add up to without their signs: as they are, and the most that they are with any phase of
/// inputs and arm. What rounding leaves of the sum is a share of the most, and no less than one of the present.
struct Terms {
  double present = 0.0, most = 0.0;

  friend Terms operator+(const Terms& a, const Terms& b) { return {a.present + b.present, a.most + b.most}; }
  friend Terms operator*(double factor, const Terms& a) { return {factor * a.present, factor * a.most}; }
};

/// Friction of the bearings of both shafts in one direction: dry [N m] and viscous, against the gear's speed
/// [N m s/rad].
struct Bearings {
  double worm_coulomb = 0.0, gear_coulomb = 0.0, worm_viscous = 0.0, gear_viscous = 0.0;
};

/// A moving mode: theta'' = per_worm_torque tau_w + per_gear_torque tau_g - drag theta', its distance from the
/// switching surface tau_w - (Jw i/Jg) tau_g - skew theta'; tau_w and tau_g hold the dry friction, not the viscous. All
/// in SI.
struct NominalEquation {
  DrivenMotion driven{};
  Mode mode{};
  bool rubs = false;
  double per_gear_torque = 0.0;
  HeldTorques friction{};  ///< what dry friction of the bearings does to the drive
  /// What the terms of per_gear_torque add up to, and of the push of dry friction: both may all but cancel, and what
  /// rounding leaves of them is a share of this.
  double most_per_gear_torque = 0.0, most_push = 0.0;
  FallOf<double> fall{};  ///< of friction over the speed

  NominalEquation() = default;
  /// mu: friction of the teeth; Jg: inertia of the gear side with the load's own; amplitude: of an arm under gravity
  /// [N m]; surface: Jw i/Jg.
  NominalEquation(const GearMesh<double>& mesh, double mu, double Jg, const AffineMotor& motor,
                  const Bearings& bearings, double amplitude, double surface, int motion, int flank)
      : mode{Motion{static_cast<std::int8_t>(motion)}, Flank{static_cast<std::int8_t>(flank)}} {
    const double C = mesh.C(motion * flank * mu), inverse = 1.0 / (mesh.Jw * mesh.i + C * Jg);
    // the other sign of friction turns the difference in C into a sum
    const double most_C = std::max(std::abs(C), std::abs(mesh.C(-motion * flank * mu)));
    const auto& [worm_coulomb, gear_coulomb, worm_viscous, gear_viscous] = bearings;
    friction = {-motion * (worm_coulomb + C * gear_coulomb) * inverse,
                -motion * (worm_coulomb - surface * gear_coulomb)};
    driven = {.held = {.motion = static_cast<double>(motion),
                       .flank = static_cast<double>(flank),
                       .gravity = amplitude * C * inverse,
                       .drag = (worm_viscous + C * gear_viscous) * inverse,
                       .lift = amplitude * surface,
                       .skew = worm_viscous - surface * gear_viscous},
              .per_command = motor.gain * inverse,
              .gain = motor.gain,
              .per_worm_torque = inverse,
              .known = {motor.offset * inverse + friction.push, motor.offset + friction.beyond}};
    rubs = driven.held.drag != 0.0 || driven.held.skew != 0.0;
    per_gear_torque = C * inverse;
    most_per_gear_torque = most_C * std::abs(inverse);
    most_push = (std::abs(worm_coulomb) + most_C * std::abs(gear_coulomb)) * std::abs(inverse);
    surface_ = surface;
  }

  /// Terms of coefficient k of theta'' and of the distance from the switching surface, of those of the torques on worm
  /// and gear and of coefficient k of theta'.
  Terms acceleration_terms(const Terms& worm, const Terms& gear, double speed, int k) const {
    const Terms load{std::abs(per_gear_torque) * gear.present, most_per_gear_torque * gear.most};
    return std::abs(driven.per_worm_torque) * worm + load + rubbing(driven.held.drag * speed) +
           (k == 0 ? Terms{std::abs(friction.push), most_push} : Terms{});
  }
  Terms distance_terms(const Terms& worm, const Terms& gear, double speed, int k) const {
    return worm + std::abs(surface_) * gear + rubbing(driven.held.skew * speed + (k == 0 ? friction.beyond : 0.0));
  }

 private:
  static Terms rubbing(double torque) { return {std::abs(torque), std::abs(torque)}; }

  double surface_ = 0.0;
};

}  // namespace wormdrive
