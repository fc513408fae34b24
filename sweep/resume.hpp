#pragma once
#include <memory>
#include <string>

#include "sweep/sweep_file.hpp"

namespace wormdrive {

/// Opens the file of a sweep for the trials that are missing. With resume it holds what NAME.part had of the same study
/// and program; without, a NAME.part with trials is refused, for it may hold hours of work. Throws InputFault.
std::unique_ptr<SweepFile> open_sweep(const std::string& path, const Study& study, TrialRange range,
                                      const std::string& command_line, bool resume);

}  // namespace wormdrive
