#pragma once
#include <optional>
#include <string>
#include <vector>

#include "description/diagnostics.hpp"
#include "description/toml/csv.hpp"

namespace wormdrive {

/// A column of a file that is no text.
struct StoredNumbers {
  std::string name;            ///< with the groups or structs in which it stands: "log/time_s", "log.time_s"
  std::string unit, comment;   ///< as the file states them; empty if it does not
  std::vector<double> values;  ///< empty where there is a defect
  std::string defect;          ///< why it cannot be a column: "is complex"; empty if it can
};

/// Columns of measured data, whatever kind of file they stand in: CSV, a MAT-file (version 5 or 7.3), HDF5.
struct DataTable {
  std::string path;
  std::optional<Csv> csv;              ///< of a text file
  std::vector<StoredNumbers> columns;  ///< of any other
  std::string scenario{};              ///< in a run that `wormdrive export --mat` wrote: what was run

  /// The column of a name: of one in a group the whole name or its last part, if no other has it. Throws InputFault if
  /// several have it.
  bool has(const std::string& name) const;
  /// Its values as they stand. Throws InputFault with the line or the row of what is no finite number.
  std::vector<double> numbers(const std::string& name) const;
  /// Its cells as texts; numbers are written out.
  std::vector<std::string> texts(const std::string& name) const;
  /// The unit that the file states beside it; empty if it does not.
  std::string unit(const std::string& name) const;
  /// Every column with its unit and comment, in one line.
  std::string described() const;
  std::vector<std::string> names() const;

  /// Where the names stand.
  Location header() const { return csv ? Location{path, 1} : Location{path}; }
  /// Where a row stands.
  Location row(std::size_t k) const { return csv ? Location{path, static_cast<std::uint32_t>(k + 2)} : Location{path}; }

 private:
  const StoredNumbers* find(const std::string& name) const;
  const StoredNumbers& sound(const std::string& name) const;
};

/// Reads a file of columns, of the kind that its first bytes tell. Throws InputFault.
DataTable read_data_table(const std::string& path);

/// Throws InputFault unless two columns of a table are equally long.
void require_equal_lengths(const DataTable& table, const std::string& a, std::size_t rows_a, const std::string& b,
                           std::size_t rows_b);

}  // namespace wormdrive
