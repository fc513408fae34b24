#pragma once
#include "recovery/truth/drive.hpp"

namespace truth {

/// Torque on the worm per torque of the gear against a load; with the load for a negative friction.
double torque_ratio(const Geometry& geometry, double friction);

/// What a number of a drive grows with, from one size of drive to another.
enum class Dimension {
  plain,  ///< shares, angles, times
  friction,
  worm_torque,
  worm_viscous,
  worm_inertia,
  gear_torque,
  gear_viscous,
  gear_inertia,
  gear_compliance,
  sliding_speed
};

/// What a course asks of the gear [rad/s^2].
inline constexpr double usual_acceleration = 28.0;

/// How much larger numbers of a kind are in a drive than in the usual one: for torques, by what it takes to lift the
/// load and to give the gear the usual acceleration.
double times_usual(Dimension dimension, const Sheet& sheet);

}  // namespace truth
