#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "output/hdf5/stored_column.hpp"
#include "output/hdf5/table.hpp"

namespace wormdrive {

/// A group of equally long columns with room for every row from the start. Writing rows changes nothing of the file's
/// structure: what a kill or a full disk interrupts are these rows, and all others stay readable.
class FixedTable {
 public:
  /// Adds such a group to a file; its rows are 0 until they are written, and take no room on the disk.
  static void create(hid_t parent, const std::string& group, const std::vector<ColumnDescription>& columns,
                     std::uint64_t rows);
  /// Opens one for writing: these of its columns.
  FixedTable(hid_t parent, const std::string& group, const std::vector<ColumnDescription>& columns);

  /// Writes values of a column from a row on; flags are rounded to int8.
  void write(std::size_t column, std::uint64_t row, const std::vector<double>& values);

 private:
  std::string group_;
  std::vector<Hdf5Handle> datasets_;
};

/// A column of texts of limited length, with room for all of them from the start.
class FixedTexts {
 public:
  static constexpr std::size_t longest = 512;  ///< bytes; what goes beyond is cut off
  static void create(hid_t parent, const std::string& name, const std::string& long_name, std::uint64_t rows);
  FixedTexts(hid_t parent, const std::string& name);
  void write(std::uint64_t row, const std::string& text);

 private:
  Hdf5Handle dataset_;
};

/// Throws ReadFault unless a column has room for so many texts as FixedTexts writes them.
void check_fixed_texts(const StoredColumn& column, std::uint64_t rows);
/// All texts of such a column up to the first empty one. Throws ReadFault.
std::vector<std::string> read_fixed_texts(hid_t parent, const std::string& name);

}  // namespace wormdrive
