#pragma once
#include <cstdint>
#include <string>

#include "cli/run_and_write.hpp"
#include "sweep/file/sweep_file.hpp"

namespace wormdrive {

/// Runs a trial of a sweep again into a result file. Throws InputFault if there is none or it was refused,
/// SimulationFailure if it cannot go on or a bit of its metrics is another one than in the sweep.
void replay_trial(const SweepReader& sweep, std::uint64_t index, const std::string& output, const RunOptions& options);

/// Writes the runs that the study wants to be kept beside a sweep that is complete, as NAME_trial_INDEX.h5, and tells
/// which.
void keep_trajectories(const std::string& sweep, const std::string& command_line, bool quiet, Replace replace);

}  // namespace wormdrive
