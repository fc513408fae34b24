#pragma once
// Scenarios that tests of several folders begin with.
#include <string>

namespace wormdrive::test {

/// The gear of the paper, without friction of its bearings.
inline const std::string mesh_of_the_paper = R"([mesh]
ratio = 60
lead_angle_deg = 4
pressure_angle_deg = 20
worm_pitch_radius_m = 0.011
gear_pitch_radius_m = 0.045
friction = 0.25
worm_inertia_kgm2 = 2.53e-5
gear_inertia_kgm2 = 7.39e-4
)";

/// A scenario without a fault; line numbers in the tests count from its first line.
inline const std::string good_scenario = "title = \"A good one\"\n" + mesh_of_the_paper + R"([motor.torque]
kind = "constant"
torque_Nm = -0.05
[load]
kind = "constant"
torque_Nm = 0.02
[run]
duration_s = 0.01
)";

/// A drive without teeth on a linear axis: its title and its [mesh].
inline const std::string sledge_of_two_kilograms = R"(title = "A sledge"
[mesh]
kind = "none"
axis = "linear"
mass_kg = 2
)";

}  // namespace wormdrive::test
