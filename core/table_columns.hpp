#pragma once
#include <algorithm>
#include <string_view>
#include <vector>

#include "core/field.hpp"
#include "core/unit.hpp"

namespace wormdrive {

/// A quantity as a key or a column of a file names it, without its unit.
struct ColumnName {
  std::string_view stem;
  Unit unit;
};

/// What the table among the parameters of a struct is called: its member `table` has values over points.
struct TableColumns {
  ColumnName points, values;              ///< the arrays in a scenario
  ColumnName point_column, value_column;  ///< the columns of a CSV file, unless it is said otherwise
};

/// The columns that the table of a parameter struct may have, by the words of its choices, each once; none without a
/// table.
template <class Parameters>
std::vector<TableColumns> possible_columns() {
  std::vector<TableColumns> all;
  if constexpr (requires(const Parameters& p) { p.columns(); }) {
    std::vector<Parameters> chosen{Parameters{}};
    for_each_choice<Parameters>([&](const auto& one) {
      const std::size_t before = chosen.size();
      for (std::size_t k = 1; k < one.words.size(); ++k)
        for (std::size_t q = 0; q < before; ++q) {
          chosen.push_back(chosen[q]);
          one.set(chosen.back(), one.words[k]);
        }
    });
    for (const Parameters& p : chosen) {
      const TableColumns columns = p.columns();
      const auto same = [&](const TableColumns& other) {
        return other.points.stem == columns.points.stem && other.values.stem == columns.values.stem;
      };
      if (std::none_of(all.begin(), all.end(), same)) all.push_back(columns);
    }
  }
  return all;
}

}  // namespace wormdrive
