#pragma once
#include "diagnosis/data/recorded_table.hpp"

namespace wormdrive {

/// Throws InputFault if a scenario states no load, most of the torque is not what its drive needs for the motion, and a
/// mass on an arm would explain it. Of a drive without a gear it says nothing.
void reject_forgotten_load(const RecordedTable& table, double period, const Scenario& scenario);

}  // namespace wormdrive
