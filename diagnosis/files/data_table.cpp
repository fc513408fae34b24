#include "diagnosis/files/data_table.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "description/one_line.hpp"
#include "diagnosis/files/stored_columns.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/in_a_copy.hpp"

namespace wormdrive {
namespace {

/// The last part of the name of a column in a group or struct.
std::string last_part(const std::string& name) { return name.substr(name.find_last_of("/.") + 1); }

enum class FileKind { text, hdf5, mat5, mat73 };

/// By its first bytes. A pipe gives its text once, and not for a look at its beginning.
FileKind kind_of_file(const std::string& path) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) return FileKind::text;
  std::string beginning(10, '\0');
  std::ifstream(path, std::ios::binary).read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  if (beginning == "MATLAB 5.0") return FileKind::mat5;
  if (!is_hdf5(path)) return FileKind::text;
  return beginning == "MATLAB 7.3" ? FileKind::mat73 : FileKind::hdf5;
}

/// Version 7.3 is read as the HDF5 that it is: matio takes no class from files that others than MATLAB wrote.
StoredContents stored(const std::string& path, FileKind kind) {
  switch (kind) {
    case FileKind::text: break;
    case FileKind::hdf5: return hdf5_columns(path);
    case FileKind::mat5: return mat5_columns(path);
    case FileKind::mat73: return mat73_columns(path);
  }
  return {};
}

/// The name of a kind of file by its ending, if it has one that is no text.
const char* promised(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending == ".mat") return "MAT-file of version 5 or 7.3";
  return ending == ".h5" || ending == ".hdf5" ? "HDF5 file" : nullptr;
}

}  // namespace

const StoredNumbers* DataTable::find(const std::string& name) const {
  const StoredNumbers* found = nullptr;
  for (const StoredNumbers& column : columns) {
    if (column.name == name) return &column;
    if (last_part(column.name) != name) continue;
    if (found)
      reject({path}, fmt::format("has two columns '{}', {} and {}; [data] in the scenario tells which it is", name,
                                 found->name, column.name));
    found = &column;
  }
  return found;
}

const StoredNumbers& DataTable::sound(const std::string& name) const {
  const StoredNumbers* const column = find(name);
  if (!column) reject({path}, fmt::format("no column '{}'; the file has {}", name, described()));
  if (!column->defect.empty()) reject({path}, fmt::format("{} {}", column->name, column->defect));
  return *column;
}

bool DataTable::has(const std::string& name) const {
  return csv ? std::find(csv->names.begin(), csv->names.end(), name) != csv->names.end() : find(name) != nullptr;
}

std::vector<double> DataTable::numbers(const std::string& name) const {
  if (csv) return csv->numbers(name);
  const StoredNumbers& column = sound(name);
  for (std::size_t k = 0; k < column.values.size(); ++k)
    if (!std::isfinite(column.values[k]))
      reject({path}, fmt::format("row {}: {} = {} is not a finite number", k + 1, column.name, column.values[k]));
  return column.values;
}

std::vector<std::string> DataTable::texts(const std::string& name) const {
  if (csv) return csv->texts(name);
  std::vector<std::string> texts;
  for (const double value : sound(name).values) texts.push_back(fmt::format("{}", value));
  return texts;
}

std::string DataTable::unit(const std::string& name) const {
  const StoredNumbers* const column = csv ? nullptr : find(name);
  return column ? column->unit : "";
}

std::vector<std::string> DataTable::names() const {
  if (csv) return csv->names;
  std::vector<std::string> names;
  for (const StoredNumbers& column : columns) names.push_back(column.name);
  return names;
}

std::string DataTable::described() const {
  constexpr std::size_t most = 20;
  std::vector<std::string> words;
  for (const StoredNumbers& column : columns) {
    std::string& word = words.emplace_back(column.name);
    if (!column.unit.empty()) word += fmt::format(" [{}]", column.unit);
    if (!column.comment.empty()) word += fmt::format(" ({})", column.comment);
    if (words.size() == most && columns.size() > most) {
      words.push_back(fmt::format("and {} more", columns.size() - most));
      break;
    }
  }
  return words.empty() ? "none" : one_line(fmt::format("{}", fmt::join(words, ", ")));
}

void require_equal_lengths(const DataTable& table, const std::string& a, std::size_t rows_a, const std::string& b,
                           std::size_t rows_b) {
  if (rows_a == rows_b) return;
  reject({table.path}, fmt::format("{} has {} rows, but {} has {}", b, rows_b, a, rows_a));
}

DataTable read_data_table(const std::string& path) {
  const FileKind kind = kind_of_file(path);
  if (kind == FileKind::text) {
    std::error_code none;
    const char* const promise = promised(path);
    if (promise && std::filesystem::is_regular_file(path, none)) reject({path}, fmt::format("is no {}", promise));
    return {path, read_csv(path), {}, {}};
  }
  if (!ends_well_in_a_copy([&] { stored(path, kind); }))
    reject({path}, "is damaged: reading it does not come to an end");
  StoredContents contents = stored(path, kind);
  DataTable table{path, std::nullopt, {}, std::move(contents.texts["scenario"])};
  table.columns = with_stated_units(std::move(contents));
  for (StoredNumbers& column : table.columns)
    for (std::string* const text : {&column.name, &column.unit, &column.comment}) *text = one_line(std::move(*text));
  return table;
}

}  // namespace wormdrive
