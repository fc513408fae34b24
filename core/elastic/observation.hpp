#pragma once
#include <array>
#include <optional>

#include "core/effect_list.hpp"
#include "core/mode.hpp"

namespace wormdrive {

/// What elastic teeth show beside, in SI.
struct ElasticTeeth {
  double theta_w;     ///< worm angle [rad]
  double omega_w;     ///< worm speed [rad/s]
  double alpha_w;     ///< worm acceleration [rad/s^2]
  double deflection;  ///< by how much the gear is ahead of the worm, theta_g - theta_w / i [rad]
  double friction;    ///< Wf [N]
  Motion gear;        ///< sign of the gear speed; forward throughout where the gear shaft has no dry friction
};

/// What the winding of a motor shows beside, in SI.
struct Winding {
  double voltage;  ///< U [V]
  double current;  ///< I [A]
  double loss;     ///< heat, R I^2 [W]
  double warmth;   ///< temperature above that of the surroundings [K]

  double power() const { return voltage * current; }  ///< out of the supply [W]
};

/// What a drive shows at one instant, in SI.
struct Observation {
  double theta_g;                                   ///< gear angle [rad]
  double omega_g;                                   ///< gear speed [rad/s]
  double alpha_g;                                   ///< gear acceleration [rad/s^2]
  double tau_m;                                     ///< motor torque [N m]
  double tau_l;                                     ///< load torque on the gear [N m]
  double normal_force;                              ///< Wn [N]
  Mode mode;                                        ///< of elastic teeth the worm's motion
  std::optional<ElasticTeeth> teeth{};              ///< of elastic teeth only
  std::optional<Winding> winding{};                 ///< of a motor with a winding only
  std::array<double, effect_state_count> states{};  ///< of the effects
};

}  // namespace wormdrive
