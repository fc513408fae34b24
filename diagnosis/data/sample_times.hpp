#pragma once
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/data/missing_rows.hpp"
#include "diagnosis/data/recorded_table.hpp"

namespace wormdrive {

/// The sample times of a recording: even, or as they are.
struct SampleTimes {
  double start, period;       ///< of the first sample, and between two samples on average [s]
  std::vector<double> times;  ///< of every sample since the first, where they are not those of one even grid [s]
  std::vector<std::string> remarks;
};

/// Puts stamps that are those of an even clock, rounded to few digits, back to what they were rounded from: of six
/// digits, or of single precision, little is left of a step after a while. Says so; nothing where the stamps are no
/// such ones.
std::optional<std::string> even_out_rounded_stamps(RecordedTable& table);

/// The times at which a recording was sampled. Stamps that miss an even grid are followed, unless the angle goes on
/// more evenly with time without them: then a clock sampled it, and the stamps were late on their way. Throws
/// InputFault where the recording is too short.
SampleTimes sample_times(const RecordedTable& table, const MissingRows& rows);

}  // namespace wormdrive
