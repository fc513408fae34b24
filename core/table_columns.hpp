#pragma once
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

/// The columns that the table of a parameter struct may have, by the words of its choices; none without a table.
template <class Parameters>
std::vector<TableColumns> possible_columns() {
  std::vector<TableColumns> all;
  if constexpr (requires(const Parameters& p) { p.columns(); }) {
    Parameters p{};
    all.push_back(p.columns());
    for_each_choice<Parameters>([&](const auto& one) {
      for (std::size_t k = 1; k < one.words.size(); ++k) {
        one.set(p, one.words[k]);
        all.push_back(p.columns());
      }
    });
  }
  return all;
}

}  // namespace wormdrive
