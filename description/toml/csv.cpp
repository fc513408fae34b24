#include "description/toml/csv.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "description/diagnostics.hpp"
#include "description/number_text.hpp"
#include "description/toml/document.hpp"

namespace wormdrive {
namespace {

std::string trimmed(std::string cell) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
  while (!cell.empty() && blank(cell.back())) cell.pop_back();
  cell.erase(0, static_cast<std::size_t>(std::find_if_not(cell.begin(), cell.end(), blank) - cell.begin()));
  return cell;
}

/// Takes what stands before a place off a text, and the mark that stands there with it.
std::string_view take_to(std::string_view& text, std::size_t place) {
  const std::string_view part = text.substr(0, place);
  text.remove_prefix(std::min(part.size() + 1, text.size()));
  return part;
}
std::string_view take(std::string_view& text, char mark) { return take_to(text, text.find(mark)); }

/// The next cell of a line; commas between quotes are part of it.
std::string_view take_cell(std::string_view& line) {
  bool quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    if (line[k] == '"') quoted = !quoted;
    if (line[k] == ',' && !quoted) return take_to(line, k);
  }
  return quoted ? take(line, ',') : take_to(line, line.size());  // a quote that is not closed is a character
}

std::vector<std::string> split(std::string_view line) {
  std::vector<std::string> cells;
  const bool ends_empty = line.ends_with(',');
  while (!line.empty()) cells.push_back(trimmed(std::string(take_cell(line))));
  if (ends_empty) cells.emplace_back();
  return cells;
}

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  ///< spreadsheets put it before the first name

/// Cells stand below the header, which is line 1.
std::uint32_t line_of(std::size_t row) { return static_cast<std::uint32_t>(row + 2); }

}  // namespace

Csv read_csv(const std::string& path) {
  std::string text = read_text(path);
  if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  if (const auto nul = std::find(text.begin(), text.end(), '\0'); nul != text.end())
    reject({path, static_cast<std::uint32_t>(1 + std::count(text.begin(), nul, '\n'))},
           "a NUL byte; a CSV file is plain text");
  std::string_view lines(text);
  Csv csv{path, {}, {}};
  const std::string header(take(lines, '\n'));
  if (trimmed(header).empty()) reject({path, 1}, "no header line with column names");
  csv.names = split(header);
  csv.columns.resize(csv.names.size());
  std::uint32_t empty_line = 0;  // tolerated at the end, where editors leave them
  for (std::uint32_t at = 2; !lines.empty(); ++at) {
    const std::string line(take(lines, '\n'));
    if (trimmed(line).empty()) {
      if (empty_line == 0) empty_line = at;
      continue;
    }
    if (empty_line != 0) reject({path, empty_line}, "an empty line inside the table");
    const std::vector<std::string> cells = split(line);
    if (cells.size() != csv.names.size())
      reject({path, at}, fmt::format("{} cells where the header has {}", cells.size(), csv.names.size()));
    for (std::size_t k = 0; k < cells.size(); ++k) csv.columns[k].push_back(cells[k]);
  }
  return csv;
}

const std::vector<std::string>& Csv::texts(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    reject({path, 1}, fmt::format("no column '{}'; the header line names {}", name, fmt::join(names, ", ")));
  return columns[static_cast<std::size_t>(found - names.begin())];
}

std::vector<double> Csv::numbers(const std::string& name) const {
  std::vector<double> values;
  for (const std::string& cell : texts(name)) {
    const std::optional<double> value = number_in(cell);
    if (!value) reject({path, line_of(values.size())}, fmt::format("{} = '{}' is not a finite number", name, cell));
    values.push_back(*value);
  }
  return values;
}

void require_increasing(const Csv& csv, const std::string& name, const std::vector<double>& values) {
  for (std::size_t k = 1; k < values.size(); ++k)
    if (!(values[k] > values[k - 1]))
      reject({csv.path, line_of(k)}, fmt::format("{} = {} does not increase after {}", name, values[k], values[k - 1]));
}

}  // namespace wormdrive
