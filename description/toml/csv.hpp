#pragma once
#include <string>
#include <vector>

namespace wormdrive {

/// Numbers and texts of a CSV file with a header line.
struct Csv {
  std::string path;
  std::vector<std::string> names;                 ///< of the columns
  std::vector<std::vector<std::string>> columns;  ///< cells, column by column

  /// The numbers of a column; throws InputFault with the line of a cell that is no finite number.
  std::vector<double> numbers(const std::string& name) const;
  /// The cells of a column as they stand; throws InputFault if there is no such column.
  const std::vector<std::string>& texts(const std::string& name) const;
};

/// Reads a CSV file; throws InputFault if it cannot be read, has no header or a line of another length.
Csv read_csv(const std::string& path);

/// Throws InputFault naming the line at which the values of a column do not increase strictly.
void require_increasing(const Csv& csv, const std::string& name, const std::vector<double>& values);

}  // namespace wormdrive
