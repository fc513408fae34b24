#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <tuple>

#include "control/controller_signals.hpp"
#include "control/lemma1.hpp"
#include "control/nominal.hpp"
#include "core/field.hpp"

namespace wormdrive {

/// A servo that takes positions: a torque in proportion to what is left to the goal, less damping, within a limit of
/// its own. With effect.dc_motor.amplifier_gain equal to the supply's voltage its torque is the duty cycle.
struct PositionServoParameters {
  static constexpr std::string_view kind = "position_servo";
  static constexpr std::string_view meaning =
      "position servo: proportional to what is left to the goal, within a limit";
  static constexpr bool without_model = true;
  double gain{};                                          ///< [N m/rad]
  double damping{0.0};                                    ///< [N m s/rad]
  double limit{std::numeric_limits<double>::infinity()};  ///< [N m]
  double dead_band{0.0};                                  ///< [rad]

  static constexpr auto fields() {
    using P = PositionServoParameters;
    constexpr Presence o = Presence::optional;
    return std::tuple{
        Field{&P::gain, "gain", unit::newton_metre_per_radian, bounds::positive, "torque per angle to the goal"},
        Field{&P::damping, "damping", unit::newton_metre_second_per_radian, bounds::not_negative,
              "torque per measured gear speed, against it", o},
        Field{&P::limit, "torque_limit", unit::newton_metre, bounds::positive,
              "largest torque that the servo asks for; unlimited if not stated", o},
        Field{&P::dead_band, "dead_band", unit::degrees, bounds::not_negative,
              "angle to the goal up to which it asks for no torque but damping", o}};
  }
};

/// It knows no model of the drive and has no integral: nothing winds up.
class PositionServo {
 public:
  explicit PositionServo(const PositionServoParameters& parameters) : p_(parameters) {}

  ControlSignals operator()(const Measurement& m) const {
    const double to_goal = m.desired.angle - m.angle;
    const double pull = std::abs(to_goal) > p_.dead_band ? p_.gain * to_goal : 0.0;
    return {.torque = std::clamp(pull - p_.damping * m.speed, -p_.limit, p_.limit)};
  }

 private:
  PositionServoParameters p_;
};

inline PositionServo make_controller(const PositionServoParameters& p, const NominalModel&, const Variations&) {
  return PositionServo(p);
}

}  // namespace wormdrive
