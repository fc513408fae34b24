#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "output/hdf5/stored_column.hpp"
#include "output/hdf5/table.hpp"

namespace wormdrive {

/// What the numbers of a column have to be; flags have to be one of those that their column knows.
enum class Range {
  any,  ///< not a number stands for what is not there
  finite,
  rising,   ///< finite, each greater than the one before
  ordered,  ///< finite, none smaller than the one before
};

/// A table of a result file that was looked at as a whole before any of it is read: its members are columns, all of
/// them equally long.
class StoredTable {
 public:
  /// Throws ReadFault if there is no such table.
  StoredTable(hid_t file, const std::string& name);

  std::uint64_t rows() const { return columns_.empty() ? 0 : columns_.front().rows(); }
  bool has(const std::string& name) const;
  /// Throws ReadFault if there is none of that name.
  const StoredColumn& column(const std::string& name) const;
  /// The names of the columns of numbers and flags.
  std::vector<std::string> numbers() const;

  /// Throws ReadFault unless it has a column of that name and type, with values in that range.
  void check(const ColumnDescription& column, Range range) const;
  /// The same of a column of texts.
  void check_texts(const std::string& column) const;

 private:
  std::string file_, name_;
  std::vector<StoredColumn> columns_;
  std::vector<std::string> names_;  ///< of the columns
};

/// The names of the members of a group, "/" for the file itself; throws ReadFault if there is no such group.
std::vector<std::string> members_of(hid_t file, const std::string& group);

/// Whether a file has a member of that name.
bool has_member(hid_t file, const std::string& name);

}  // namespace wormdrive
