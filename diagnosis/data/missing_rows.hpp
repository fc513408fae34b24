#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "diagnosis/data/recorded_table.hpp"

namespace wormdrive {

/// Rows that a logger has lost.
struct MissingRows {
  double step;                      ///< usual one between two rows [s]
  std::vector<std::uint8_t> there;  ///< of every row, 0 where it was put in
  std::string remark;               ///< empty: none is missing
};

/// Finds missing rows by the times of the others. Short runs of them are put in, interpolated, so that whatever goes by
/// rows finds the time that has passed; longer ones are a pause, and the table starts anew after it. The torque is
/// interpolated, not held: with one row missing that is never the worse guess in the mean square, however the torque
/// is correlated. Throws InputFault, with the line, for too few rows, a time that is negative, repeated or decreasing,
/// for steps that show no rate or one that is too slow, and if more is missing than there.
MissingRows bridge_missing_rows(RecordedTable& table);

}  // namespace wormdrive
