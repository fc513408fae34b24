#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "description/scenario.hpp"

namespace wormdrive {

/// A sample that no measurement can have given, with its distance from the record's median in robust standard
/// deviations.
struct ImplausibleSample {
  std::uint32_t line;  ///< in a text file, 0 in any other
  double torque;       ///< [N m]
  double deviations;
};

/// One recording at constant speed: means over the plausible samples.
struct SpeedTorqueRecord {
  std::string name;
  double worm_speed;    ///< [rad/s]
  double motor_torque;  ///< [N m]
  std::size_t samples;  ///< that entered the means
  std::vector<ImplausibleSample> left_out;
};

/// Reads a CSV, MAT or HDF5 file with the columns record, worm_speed_rad_per_s and motor_torque_Nm, or what the
/// scenario calls them; records in the order of the file. Throws InputFault for a file that cannot be read so.
std::vector<SpeedTorqueRecord> read_speed_torque_records(const std::string& path, const Scenario& scenario = {});

}  // namespace wormdrive
