#pragma once
#include <cstddef>
#include <string>
#include <vector>

#include "description/scenario.hpp"

// What programs share that step a gear and count what their whole process allocates.

extern long allocations;  ///< since the process began

/// The gear, as a scenario.
inline constexpr const char* gear =
    "[mesh]\nratio = 60\nlead_angle_deg = 4\npressure_angle_deg = 20\nworm_pitch_radius_m = 0.011\n"
    "gear_pitch_radius_m = 0.045\nfriction = 0.25\nworm_inertia_kgm2 = 2.53e-5\ngear_inertia_kgm2 = 7.39e-4\n"
    "[load]\nkind = \"gravity_arm\"\ntorque_Nm = 0.0196\n[run]\nduration_s = 1\n";

/// count of them, each with more friction than the one before.
std::vector<wormdrive::Scenario> gears(std::size_t count, const std::vector<std::string>& overrides);
