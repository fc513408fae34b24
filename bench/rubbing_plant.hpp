#pragma once
#include <array>
#include <cmath>

#include "bench/plant.hpp"

namespace bench {

/// What rubs besides teeth of constant friction: a Stribeck curve over the sliding speed, and bearings of both shafts.
struct Rubbing {
  double drop, speed;                 ///< friction is drop lower far above this sliding speed [m/s]; exponent 1
  double worm_coulomb, gear_coulomb;  ///< [N m]
  double worm_viscous, gear_viscous;  ///< [N m s/rad]
};
/// The curve of scenarios/fig09_stribeck.toml.
inline constexpr Rubbing rubbing{
    .drop = 0.15, .speed = 0.1, .worm_coulomb = 1e-3, .gear_coulomb = 2e-3, .worm_viscous = 1e-5, .gear_viscous = 1e-4};

/// The same drive as Plant with `rubbing`, programmed in the same way.
template <Case inputs>
class RubbingPlant : public Plant<inputs, double> {
  using Base = Plant<inputs, double>;

 public:
  using State = typename Base::State;
  using Base::mode, Base::held, Base::evaluations, Base::load_torque, Base::surface;

  void derivative(double, const double* y, double* rate) {
    ++evaluations;
    rate[0] = y[1];
    rate[1] = acceleration(mode, y[0], y[1]);
  }
  void roots(double, const double* y, double* g) const {
    g[0] = motion(mode) * y[1];
    g[1] = -flank(mode) * beyond_surface(motion(mode), y[0], y[1]);
  }

  Mode from_rest(double, double theta) const {
    const Mode forward = beyond_surface(1, theta, 0.0) <= 0.0 ? Mode::forward_left : Mode::forward_right;
    if (acceleration(forward, theta, 0.0) > 0.0) return forward;
    const Mode backward = beyond_surface(-1, theta, 0.0) <= 0.0 ? Mode::backward_left : Mode::backward_right;
    if (acceleration(backward, theta, 0.0) < 0.0) return backward;
    return Mode::stuck;
  }
  Mode settle(double t, const State& y) const {
    if (y[1] == 0.0) return from_rest(t, y[0]);
    const bool left = beyond_surface(y[1] > 0.0 ? 1 : -1, y[0], y[1]) <= 0.0;
    if (y[1] > 0.0) return left ? Mode::forward_left : Mode::forward_right;
    return left ? Mode::backward_left : Mode::backward_right;
  }

 private:
  double worm_torque(int direction, double omega) const {
    return held - direction * rubbing.worm_coulomb - worm_drag * omega;
  }
  static double gear_torque(int direction, double theta, double omega) {
    return load_torque(theta) - direction * rubbing.gear_coulomb - rubbing.gear_viscous * omega;
  }
  double beyond_surface(int direction, double theta, double omega) const {
    return worm_torque(direction, omega) - surface * gear_torque(direction, theta, omega);
  }
  double acceleration(Mode in, double theta, double omega) const {
    const double friction = least + rubbing.drop * std::exp(-std::abs(omega) * per_speed);
    const double m = motion(in) * flank(in) * friction;
    const double worm_lever = Base::lw * (worm_lever_0 - m * Base::cos_lambda),
                 gear_lever = Base::lg * (gear_lever_0 + m * Base::sin_lambda);
    return (gear_lever * worm_torque(motion(in), omega) + worm_lever * gear_torque(motion(in), theta, omega)) /
           (gear_lever * Base::Jw_i + worm_lever * Base::Jg);
  }

  static constexpr double i = 60.0, least = Base::mu - rubbing.drop, worm_drag = rubbing.worm_viscous * i;
  const double per_speed = Base::lw * i / Base::cos_lambda / rubbing.speed;
  const double worm_lever_0 = Base::cos_phi * Base::sin_lambda, gear_lever_0 = Base::cos_phi * Base::cos_lambda;
};

}  // namespace bench
