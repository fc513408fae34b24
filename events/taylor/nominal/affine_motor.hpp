#pragma once
#include <type_traits>

#include "core/effects/dc_motor.hpp"
#include "core/effects/torque_gain.hpp"
#include "core/effects/torque_offset.hpp"
#include "core/numbers/series.hpp"

namespace wormdrive {

/// Effects that make another torque, affine in command and speed of the worm, of the motor's command.
template <class Effect>
inline constexpr bool is_affine_motor =
    std::is_same_v<Effect, DcMotor<double>> || std::is_same_v<Effect, TorqueGain<double>> ||
    std::is_same_v<Effect, TorqueOffset<double>>;

/// A motor whose torque is gain command + offset - brake theta_w' [N m].
struct AffineMotor {
  double gain = 1.0, offset = 0.0, brake = 0.0;

  /// The same with an effect, by its own equations: a torque and its slope are a series.
  template <class Effect>
  AffineMotor with(const Effect& effect) const {
    using Slope = Series<double, 1>;
    const Moment<Slope> still{.t = 0.0, .theta_g = 0.0, .omega_g = 0.0, .omega_w = 0.0};
    Moment<Slope> turning = still;
    turning.omega_w = Slope::variable(0.0);
    const auto torque = [&](double slope, const Moment<Slope>& at) {
      Slope before(offset);
      before[1] = slope;
      return effect.motor_torque(before, at);
    };
    const Slope of_command = torque(gain, still), of_speed = torque(-brake, turning);
    return {.gain = of_command[1], .offset = of_command[0], .brake = -of_speed[1]};
  }
};

}  // namespace wormdrive
