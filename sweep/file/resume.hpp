#pragma once
#include <memory>
#include <string>
#include <vector>

#include "sweep/file/sweep_file.hpp"

namespace wormdrive {

/// A sweep that is to be made, or to be gone on with.
struct OpenSweep {
  OutputLock lock;
  std::unique_ptr<SweepFile> file;  ///< none where NAME itself holds every trial
  std::vector<TrialRange> missing;
  std::uint64_t failed = 0;  ///< trials that are there but not done
};

/// Throws InputFault if trials of a file cannot stand beside those of a study, naming what differs, or if it is made
/// for other trials than those of the range.
void reject_another_sweep(const SweepReader& there, const Study& study, TrialRange range);
/// Throws InputFault: a file of an interrupted sweep is neither gone on with nor overwritten.
[[noreturn]] void reject_restart(const SweepReader& there);

/// Opens the file of a sweep for the trials that are missing. With resume it keeps what NAME.part has of the same study
/// and program, and leaves a NAME that is complete as it is; without, a NAME.part with trials is refused, for it may
/// hold hours of work, unless anything may be replaced. lock: of the path. Throws InputFault, and OutputFault if NAME
/// may not be replaced.
OpenSweep open_sweep(const std::string& path, OutputLock lock, const Study& study, TrialRange range,
                     const std::string& command_line, bool resume, Replace replace = Replace::same_kind);

}  // namespace wormdrive
