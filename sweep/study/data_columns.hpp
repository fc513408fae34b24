#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "description/toml/csv.hpp"
#include "description/toml/table_reader.hpp"

namespace wormdrive {

/// The name of a file whichever way it is written: "./draws.csv" is "draws.csv".
std::string same_for_one_file(const std::string& name);

/// Columns of CSV files that a study names. Once read they stand in the text of the study, as [data."FILE.csv"] with a
/// list for each column, so that a sweep can be understood, replayed and repeated without the file.
class DataColumns {
 public:
  /// root: the study; folder: where its files lie, or nothing where the text has to hold all of them.
  DataColumns(const toml::table& root, std::optional<std::string> folder) : root_(root), folder_(std::move(folder)) {}

  /// The values of a column of the file that a key of a table names, in the order of the rows; empty where a fault was
  /// noted.
  std::vector<double> read(TableReader& table, const std::string& key, const std::string& file,
                           const std::string& column);
  /// What was read from files as TOML, to be added to the text of the study.
  std::string text() const;

 private:
  /// The file as it stands on the disk; null where a fault was noted.
  const Csv* csv(TableReader& table, const std::string& key, const std::string& file);
  /// The column as the text of the study has it.
  std::optional<std::vector<double>> stated(const std::string& file, const std::string& column) const;

  const toml::table& root_;
  std::optional<std::string> folder_;
  std::map<std::string, std::optional<Csv>> files_;  ///< nothing of one that could not be read
  std::map<std::string, std::map<std::string, std::vector<double>>> read_;
  std::map<std::string, std::size_t> rows_;  ///< of each file
};

}  // namespace wormdrive
