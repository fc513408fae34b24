#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "description/scenario.hpp"
#include "diagnosis/data/recorded_table.hpp"

namespace wormdrive {

/// What speaks against single samples of a recording.
struct SampleLimits {
  double period;                ///< [s]
  double largest_acceleration;  ///< that the drive can have at the gear [rad/s^2]
  double ratio;                 ///< of the worm's angle to the gear's
  double impact_speed;          ///< that a worm gives the gear at once when it has crossed a gap [rad/s]
};

/// The widest gap between the teeth of a drive, at the gear [rad]. ratio: of the worm's angle to the gear's.
double widest_gap(double ratio);

/// Those of a scenario's drive, with the torque of a recording [N m].
SampleLimits sample_limits(const Scenario& scenario, double period, const std::vector<double>& torque);

/// Marks samples that no measurement can have given with 0 in `valid`, and puts what their neighbours suggest in their
/// place: angles off the path of their neighbours, torques of another size than all others. One sentence for each group
/// of them. Throws InputFault where the angle jumps for good, where a reading stands still while the drive moves, and
/// where too many samples are impossible.
std::vector<std::string> leave_out_impossible(RecordedTable& table, const SampleLimits& limits,
                                              std::vector<std::uint8_t>& valid);

/// The step of an encoder as the readings that are valid show it [rad], 0 if they show none.
double resolution(const std::vector<double>& angles, const std::vector<std::uint8_t>& valid);

}  // namespace wormdrive
