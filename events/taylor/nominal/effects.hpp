#pragma once
#include <optional>
#include <type_traits>

#include "core/worm_drive.hpp"
#include "events/taylor/nominal/affine_motor.hpp"
#include "events/taylor/nominal/equation.hpp"
#include "events/taylor/nominal/stribeck.hpp"

namespace wormdrive {

/// The Stribeck curve of a drive, in a motion that has formulas of its own.
class StribeckCurve {
 public:
  using Fall = FallOf<double>;

  StribeckCurve() = default;
  StribeckCurve(const Stribeck<double>& effect, const GearMesh<double>& mesh)
      : drop_(effect.drop),
        least_(mesh.mu - effect.drop),
        per_speed_(std::abs(mesh.sliding_speed(mesh.i)) / effect.speed),
        exponent_(static_cast<int>(std::ceil(effect.exponent))),
        has_tail_(effect.tail > 0.0) {}

  bool falls() const { return exponent_ > 0; }
  int exponent() const { return exponent_; }
  bool has_tail() const { return has_tail_; }
  double least_friction() const { return least_; }

  /// least_mu: the lowest friction of the mode; product: its motion times flank; Jg: inertia of the gear side with the
  /// load's own.
  Fall fall(const GearMesh<double>& mesh, double least_mu, double Jg, int product) const {
    const auto inertia = [&](double mu) {
      return mesh.Jw * mesh.i * mesh.gear_arm(product * mu) + Jg * mesh.worm_arm(product * mu);
    };
    const double least = inertia(least_mu);
    return {mesh.lg * mesh.lw * portable::cos(mesh.phi_n) * product * drop_ * Jg / (least * least),
            (inertia(least_mu + drop_) - least) / least,
            per_speed_,
            1.0 / per_speed_,
            exponent_,
            has_tail_};
  }

 private:
  double drop_ = 0.0, least_ = 0.0, per_speed_ = 0.0;
  int exponent_ = 0;  ///< 0: friction does not fall
  bool has_tail_ = false;
};

/// What the effects of a drive are in the formulas of its nominal motion. swings: an arm under gravity loads it.
template <bool swings>
struct NominalEffects {
  AffineMotor response;     ///< of the motor to its command
  StribeckCurve curve;      ///< of friction over the speed
  double load_gain = 1.0;   ///< of a load over time
  bool are_covered = true;  ///< false with an effect that the formulas do not know

  template <class System>
  explicit NominalEffects(const System& system) {
    system.effects().for_each([&]<class E>(const std::optional<E>& effect) {
      if (!effect) return;
      if constexpr (is_affine_motor<E>)
        response = response.with(*effect);
      else if constexpr (std::is_same_v<E, WormCoulomb<double>>)
        bearings_.worm_coulomb = effect->torque;
      else if constexpr (std::is_same_v<E, GearCoulomb<double>>)
        bearings_.gear_coulomb = effect->torque;
      else if constexpr (std::is_same_v<E, WormViscous<double>>)
        bearings_.worm_viscous += effect->coefficient * system.mesh().i;
      else if constexpr (std::is_same_v<E, GearViscous<double>>)
        bearings_.gear_viscous = effect->coefficient;
      else if constexpr (std::is_same_v<E, BearingAsymmetry<double>>)
        uneven_ = *effect;
      else if constexpr (std::is_same_v<E, Stribeck<double>>)
        curve = {*effect, system.mesh()};
      else if constexpr (std::is_same_v<E, FrictionAsymmetry<double>>)
        asymmetry_ = effect->change;
      else if constexpr (!swings && std::is_same_v<E, LoadMagnitude<double>>)
        load_gain = 1.0 + effect->share;
      else if constexpr (!contained<E>)
        are_covered = false;
    });
    bearings_.worm_viscous += response.brake * system.mesh().i;
    const bool rubs = bearings_.worm_viscous != 0.0 || bearings_.gear_viscous != 0.0 || uneven_.coefficient != 0.0;
    are_covered = are_covered && !(system.motor_input().lags() && (rubs || curve.falls()));
  }

  /// The equation of a moving mode. amplitude: of an arm under gravity [N m]; surface: Jw i/Jg.
  template <class System>
  NominalEquation equation(const System& system, double amplitude, double surface, int motion, int flank) const {
    const GearMesh<double>& mesh = system.mesh();
    const double mu = (curve.falls() ? curve.least_friction() : mesh.mu) + motion * asymmetry_;
    Bearings here = bearings_;
    here.worm_coulomb += motion * uneven_.torque;
    here.worm_viscous += motion * uneven_.coefficient * mesh.i;
    NominalEquation equation{mesh, mu, system.Jg(), response, here, amplitude, surface, motion, flank};
    equation.fall = curve.fall(mesh, mu, system.Jg(), motion * flank);
    return equation;
  }

 private:
  /// Effects that inertias and inputs, as the system tells them, contain, and those that do not touch a motion.
  template <class E>
  static constexpr bool contained = std::is_same_v<E, TorqueSaturation<double>> ||
                                    std::is_same_v<E, ActuatorDelay<double>> ||
                                    std::is_same_v<E, ActuatorLag<double>> || std::is_same_v<E, WormInertia<double>> ||
                                    std::is_same_v<E, GearInertia<double>> ||
                                    (!swings && std::is_same_v<E, LoadAngle<double>>) ||
                                    std::is_same_v<E, StaticFriction<double>> || E::place == Place::sensor;

  Bearings bearings_;
  BearingAsymmetry<double> uneven_{};
  double asymmetry_ = 0.0;  ///< of the friction between the teeth
};

}  // namespace wormdrive
