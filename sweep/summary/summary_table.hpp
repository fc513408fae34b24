#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "output/hdf5/fixed_table.hpp"
#include "sweep/study/study.hpp"

namespace wormdrive {

/// A table of the summary: its columns, texts beside them, and rows as they are filled.
struct SummaryTable {
  std::string name;
  std::uint64_t rows;
  std::vector<ColumnDescription> columns;
  std::vector<std::pair<std::string, std::string>> texts;  ///< name, long name

  std::string group() const { return "summary/" + name; }
};

SummaryTable status_table();
SummaryTable metric_table(const Study& study);
SummaryTable threshold_table(const Study& study);
SummaryTable influence_table(const Study& study);
SummaryTable worst_table(const Study& study);
SummaryTable condition_table(const Study& study);
SummaryTable screening_table(const Study& study);
SummaryTable shapley_table(const Study& study);
SummaryTable pair_table(const Study& study);

}  // namespace wormdrive
