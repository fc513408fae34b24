#pragma once
#include <string>
#include <utility>
#include <vector>

#include "output/hdf5.hpp"

namespace wormdrive {

/// A result file to read from, with the names of what is in it.
class ResultFile {
 public:
  /// Throws InputFault if it is no result file.
  explicit ResultFile(const std::string& path);

  const std::string& path() const { return path_; }
  bool has(const std::string& table) const { return H5Lexists(file_, table.c_str(), H5P_DEFAULT) > 0; }
  std::vector<double> column(const std::string& name) const { return read_column(file_, name); }
  /// A column of texts.
  std::vector<std::string> texts(const std::string& name) const;
  /// The columns of numbers of a table, flags included.
  std::vector<std::string> columns(const std::string& table) const;
  /// The attributes of an object that are one number, by their names.
  std::vector<std::pair<std::string, double>> numbers(const std::string& object) const;
  /// A text attribute of an object of the file, "/" for the file itself; empty if there is none.
  std::string attribute(const std::string& object, const std::string& name) const;

 private:
  std::string path_;
  Hdf5Handle file_;
};

}  // namespace wormdrive
