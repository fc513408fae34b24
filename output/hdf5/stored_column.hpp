#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "output/hdf5/hdf5.hpp"

namespace wormdrive {

/// A column of a result file that was looked at before any of it is read: it has one dimension and one of the types of
/// output/schema.md, it lies in this file as it is, neither compressed nor elsewhere, and the file is large enough to
/// hold all its rows. So what is read of it never takes more memory than the file is long.
class StoredColumn {
 public:
  /// number: 64-bit float; flag: 8-bit integer; text: of any length; padded_text: of a length that all rows share
  enum class Type { number, flag, text, padded_text };

  /// Throws ReadFault if there is no such column.
  StoredColumn(hid_t file, const std::string& path) : StoredColumn(file, path, path) {}
  /// The same of a column in a group that is open; path: that in the file.
  StoredColumn(hid_t place, const std::string& name, const std::string& path);

  const std::string& path() const { return path_; }
  Type type() const { return type_; }
  std::uint64_t rows() const { return rows_; }
  std::uint64_t bytes_per_row() const { return bytes_per_row_; }
  /// Values of numbers or flags, so many from a row on; throws ReadFault if it holds texts or is shorter.
  std::vector<double> values(std::uint64_t first, std::uint64_t count) const;
  std::vector<double> values() const { return values(0, rows_); }
  /// All texts; throws ReadFault if it holds none.
  std::vector<std::string> texts() const;

  /// Throws ReadFault: "its column 'PATH' WHAT".
  [[noreturn]] void reject(const std::string& what) const;

 private:
  std::vector<std::string> read_texts() const;
  std::vector<std::string> read_padded_texts() const;

  std::string file_, path_;
  Hdf5Handle dataset_;
  Type type_ = Type::number;
  std::uint64_t rows_ = 0, bytes_per_row_ = 0;
  std::uint64_t bytes_ = 0;  ///< of the file
};

/// All values of a column of numbers or flags. Throws ReadFault.
std::vector<double> read_column(hid_t file, const std::string& path);

}  // namespace wormdrive
