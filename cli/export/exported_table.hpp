#pragma once
#include <string>
#include <vector>

#include "cli/report/result_file.hpp"

namespace wormdrive {

/// A column of a run for other programs: a number with its unit, or a flag with the words for its values.
struct ExportedColumn {
  std::string name;
  std::string units;    ///< as in the file, "rad/s"; empty for flags
  std::string meaning;  ///< one phrase; for flags the words for their values behind it
  std::vector<double> values;
};

/// A table of a run for other programs.
struct ExportedTable {
  std::string name;  ///< "trajectory"
  std::vector<ExportedColumn> columns;
};

/// The tables that a run has, in the order trajectory, events, controller.
std::vector<ExportedTable> exported_tables(const ResultFile& run);

/// A table as CSV with units as suffixes of the names; signs stay numbers, kinds of events are words. Its first line is
/// the header.
std::string csv_of(const ExportedTable& table);

/// The tables as a MAT-file of version 5: a struct for each with its columns, the struct `units` with a struct for
/// each, and texts about the run. Throws OutputFault, with nothing left behind, unless all of it can be read back.
void write_mat(const std::string& path, const std::vector<ExportedTable>& tables,
               const std::vector<std::pair<std::string, std::string>>& texts);

/// What tells a MAT-file of this program.
inline constexpr const char* mat_mark = "MATLAB 5.0 MAT-file, written by wormdrive";

}  // namespace wormdrive
