#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "recovery/truth/drive.hpp"

namespace truth {

/// What a test bench writes down: one sample per period; and, for tests of the bench itself, what no sensor sees.
struct Recording {
  std::vector<double> time, motor_torque, gear_angle;
  std::vector<double> worm_angle;  ///< empty without an encoder on the worm
  std::vector<double> true_angle, true_speed, true_worm_speed, mechanical_energy;
  int time_digits = 4;  ///< decimals of the times as they are written
};

/// The torque commanded at a time, out of the angle that the encoder shows there.
using Law = std::function<double(double time, double seen_angle)>;

struct RecordingSettings {
  double duration = 24.0, period = 1e-3;  ///< [s]
  double step = 1e-5;                     ///< of the integration [s]; a whole number of them is a period
  double jitter = 0.0;                    ///< most by which a sample is early or late [periods], below 0.5
  double start_angle = 0.0;               ///< at rest, the teeth loaded by what the arm weighs there
  std::uint64_t seed = 1;                 ///< of all noise
};

/// Runs the drive under a law of control, which holds its torque from sample to sample, and records it.
Recording record(const Drive& drive, const Law& law, const RecordingSettings& settings);

/// Writes time_s, motor_torque_Nm, gear_angle_rad and, with an encoder on the worm, worm_angle_rad; throws
/// std::runtime_error if it cannot.
void write_csv(const Recording& recording, const std::string& path);

}  // namespace truth
