#pragma once
#include <string>
#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/points/torque_points.hpp"

namespace wormdrive {

/// A load with the motor torque at which the gear starts to turn.
struct BreakIn {
  double load_torque;   ///< [N m]
  double motor_torque;  ///< [N m]
};

/// Reads a CSV with the columns load_torque_Nm and motor_torque_Nm, or what the scenario calls them. Throws InputFault
/// for a file that cannot be read so, or that has fewer than six rows.
std::vector<BreakIn> read_break_in_table(const std::string& path, const Scenario& scenario);

/// Break-ins as torque points, each expected to be off in proportion to its torque; the direction is that whose
/// predicted torque is nearer.
TorquePoints break_in_points(const std::vector<BreakIn>& table, const Scenario& scenario);

/// C1 and C2 as the slopes of the points, and the friction at rest that follows from both, as [YehWu2009, fig. 7] does
/// it; with 95 % intervals.
std::vector<Estimate> identified_constants(const TorquePoints& points, const Scenario& scenario);

}  // namespace wormdrive
