#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "output/hdf5/hdf5.hpp"

namespace wormdrive {

/// How a column of a table stands in the file.
struct ColumnDescription {
  std::string name;
  std::string units;               ///< "rad/s", "1" for pure numbers; empty for flags
  std::string long_name;           ///< one phrase
  std::string flag_meanings = {};  ///< for flags: one word a value, separated by blanks (CF conventions)
  std::vector<std::int8_t> flag_values = {};

  bool is_flag() const { return !flag_values.empty(); }
};

/// A growing group of equally long columns in an HDF5 file; the first column is the dimension scale of the others.
class GrowingTable {
 public:
  /// expected_rows: about how many there will be, where that is known; a short table then takes little room.
  GrowingTable(hid_t parent, const std::string& group, std::vector<ColumnDescription> columns,
               hsize_t expected_rows = 0);

  /// Appends rows, given column by column in the order of the descriptions; flags are rounded to int8.
  void append(const std::vector<std::vector<double>>& columns);

  /// The group, for attributes of the table as a whole.
  hid_t group() const { return group_; }

 private:
  std::vector<ColumnDescription> descriptions_;
  Hdf5Handle group_;
  std::vector<Hdf5Handle> datasets_;
  hsize_t rows_ = 0;
};

/// Creates an empty column of a table with its attributes; scale: the table's first column, if there is one.
Hdf5Handle create_column(hid_t group, const ColumnDescription& column, hid_t space, hid_t properties, hid_t scale,
                         const std::string& action);

/// A text column beside a table, such as names.
void write_texts(hid_t group, const std::string& name, const std::string& long_name,
                 const std::vector<std::string>& texts);

}  // namespace wormdrive
