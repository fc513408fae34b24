#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/numbers/cubic_table.hpp"
#include "core/table_columns.hpp"
#include "description/toml/table_reader.hpp"

namespace wormdrive {

/// Two columns of equal length.
struct Pairs {
  std::vector<double> x, y;
};

/// Reads points and values, of which the points must increase; CSV files are looked for in `folder`. Diagnostics leave
/// both empty.
Pairs read_pairs(TableReader& table, const TableColumns& columns, std::size_t at_least, const std::string& folder);

/// Reads fields and choices of a parameter struct and then the table among them, as far as it has them.
template <class Parameters>
void read_parameters(TableReader& table, Parameters& parameters, const std::string& folder) {
  if constexpr (requires { Parameters::fields(); }) table.read_fields(parameters);
  if constexpr (requires { parameters.columns(); }) {
    const Pairs pairs = read_pairs(table, parameters.columns(), 4, folder);
    if (!pairs.x.empty()) parameters.table = CubicTable(pairs.x, pairs.y);
  }
}

/// Calls read(), which reads the CSV file that a key of a table names; what is wrong with the file is noted where it
/// stands, and the key that has named it.
void tell_faults_of_file(TableReader& table, const std::string& key, const std::string& file,
                         const std::function<void()>& read);

}  // namespace wormdrive
