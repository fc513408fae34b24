#pragma once
#include <array>
#include <vector>

#include "description/scenario.hpp"
#include "diagnosis/data/prepared_recording.hpp"

namespace wormdrive {

/// How large things are in a drive and its recordings: what steps and bounds of fits are shares of.
struct Magnitudes {
  double torque{};                       ///< rms of the command [N m]
  double largest_torque{};               ///< [N m]
  std::array<double, 3> rare_torques{};  ///< that 4, 15 and 50 of a thousand commands exceed [N m]
  double gear_speed{};                   ///< rms [rad/s]
  double worm_speed{};                   ///< rms [rad/s]
  double sliding_speed{};                ///< of the teeth, rms [m/s]; 0 without teeth
  double load_torque{};                  ///< largest on the gear in the motions of the recordings [N m]
  double stated_friction{};              ///< of the mesh; 0 without teeth
  double friction{};                     ///< the same, at least that at which the gear locks itself
  double worm_inertia{};                 ///< [kg m^2]; without teeth the only one
  double gear_inertia{};                 ///< with the load's own [kg m^2]; 0 without teeth
  double duration{};                     ///< of the longest recording [s]
  double period{};                       ///< of the slowest sampling [s]
  double torque_memory{};                ///< after which a command tells half of another, in the fastest recording [s]
  bool has_teeth = true;
  double widest_gap{};            ///< between the teeth, at the gear [rad]; 0 without teeth
  double gear_arm{};              ///< lever arm of the teeth's normal force on the gear [m]; 0 without teeth
  bool has_worm_encoder = false;  ///< in one of the recordings at least
  bool load_turns = false;        ///< the load's torque depends on the gear angle
};

Magnitudes magnitudes(const Scenario& scenario, const std::vector<PreparedRecording>& recordings);

}  // namespace wormdrive
