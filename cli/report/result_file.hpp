#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "description/scenario.hpp"
#include "output/hdf5/stored_table.hpp"

namespace wormdrive {

/// Who wrote a result: this program a moment ago, or anybody, so that a copy of this process reads it first.
enum class Writer { anybody, this_program };

/// A result file to read from, with the names of what is in it. All of it was looked at when it was opened.
class ResultFile {
 public:
  /// Throws InputFault if it is no result file, or a damaged one.
  explicit ResultFile(const std::string& path, Writer writer = Writer::anybody);

  const std::string& path() const { return path_; }
  bool has(const std::string& table) const { return has_member(file_, table); }
  std::vector<double> column(const std::string& name) const { return read_column(file_, name); }
  /// What was simulated. Throws InputFault.
  Scenario scenario() const;
  /// A column of texts.
  std::vector<std::string> texts(const std::string& name) const;
  /// The columns of numbers of a table, flags included.
  std::vector<std::string> columns(const std::string& table) const;
  /// The attributes of a table that are one number, by their names.
  std::vector<std::pair<std::string, double>> numbers(const std::string& table) const;
  /// A number, or a whole number, that is an attribute of an object, "/" for the file itself; throws ReadFault if there
  /// is none.
  double number(const std::string& object, const std::string& name) const {
    return read_number_attribute(open_object(file_, object), name);
  }
  std::int64_t integer(const std::string& object, const std::string& name) const {
    return read_integer_attribute(open_object(file_, object), name);
  }
  /// A text attribute of an object of the file, "/" for the file itself; empty if there is none.
  std::string attribute(const std::string& object, const std::string& name) const;

 private:
  std::string path_;
  Hdf5Handle file_;
};

/// Throws InputFault with the faults of all that are no result files, or damaged ones.
std::vector<ResultFile> open_results(const std::vector<std::string>& paths);

}  // namespace wormdrive
