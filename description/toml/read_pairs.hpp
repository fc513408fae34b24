#pragma once
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "description/toml/table_reader.hpp"

namespace wormdrive {

/// Two columns of equal length.
struct Pairs {
  std::vector<double> x, y;
};

/// A quantity as a table or a CSV file names it.
struct Name {
  std::string_view stem;
  Unit unit;
  std::string spelled(Axis axis) const { return spellings(stem, unit, axis).front().key; }
};

/// Where x and y of a table stand: inline as arrays, or in a CSV file.
struct PairSource {
  Name x, y;                ///< the inline arrays
  Name x_column, y_column;  ///< the columns of the file, unless it is said otherwise
  std::size_t at_least;
};

/// Reads x and y, of which x must increase; CSV files are looked for in `folder`. Diagnostics leave both empty.
Pairs read_pairs(TableReader& table, const PairSource& source, const std::string& folder);

/// Calls read(), which reads the CSV file that a key of a table names; what is wrong with the file is noted where it
/// stands, and the key that has named it.
void tell_faults_of_file(TableReader& table, const std::string& key, const std::string& file,
                         const std::function<void()>& read);

}  // namespace wormdrive
