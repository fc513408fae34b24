#pragma once
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "cli/commands/diff/compared_tables.hpp"
#include "cli/report/result_file.hpp"

namespace wormdrive {

/// Where one row of a table stands: in the order of the columns that say so.
using RowPlace = std::vector<std::variant<double, std::string>>;

/// "12.5, 0.3"; "-" if it is nowhere.
std::string in_words(const RowPlace& place);

/// Where the rows of a table stand.
struct RowPlaces {
  std::vector<std::vector<double>> numbers;     ///< column by column
  std::vector<std::vector<std::string>> texts;  ///< likewise
  std::vector<std::size_t> rows;                ///< all of them but those that wait for a run, sorted by their places

  RowPlace operator[](std::size_t row) const;
};
RowPlaces row_places(const ResultFile& file, const ComparedTable& table);

/// Rows of two tables that stand at the same place.
struct PairedRows {
  std::vector<std::pair<std::size_t, std::size_t>> common;
  std::size_t first_only = 0, second_only = 0;
};
PairedRows paired_rows(const RowPlaces& a, const RowPlaces& b);

}  // namespace wormdrive
