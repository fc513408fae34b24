#pragma once
#include <cstdint>
#include <vector>

#include "diagnosis/data/recorded_table.hpp"

namespace wormdrive {

/// Throws InputFault if torque and motion can only be those of the scenario's drive when read in another unit, with
/// another sign, or one for the other; and if nothing was moved, or nothing moved. What merely fits badly passes: that
/// is for the diagnosis. Rows that are not there, but interpolated, tell nothing of an encoder's steps.
void refuse_implausible_units(const RecordedTable& table, const std::vector<std::uint8_t>& there, double period,
                              const Scenario& scenario);

/// Throws InputFault if the torque is more than ten times what the drive needs for the motion, or less than a tenth.
/// Of a drive without a gear it says nothing: most of its torque may be friction that is not stated.
void refuse_implausible_size(const RecordedTable& table, double period, const Scenario& scenario);

}  // namespace wormdrive
