#pragma once
#include <string>

#include "description/scenario.hpp"
#include "diagnosis/data/recording.hpp"

namespace wormdrive {

/// Reads a recording of the scenario's drive from a CSV file (time_s, motor_torque_Nm, gear_angle_rad, perhaps
/// worm_angle_rad; or what the scenario's [data] calls them) or from a run's HDF5 file, and checks that it can be one:
/// rising sample times, units that fit the drive, an encoder that works. Missing rows and single impossible samples are
/// left out and told in the remarks. Throws InputFault, one sentence with file and line, for everything that must not
/// pass for physics.
Recording read_recording(const std::string& path, const Scenario& scenario);

}  // namespace wormdrive
