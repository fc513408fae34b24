#include "scenarios/csv.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <sstream>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scenarios/document.hpp"
#include "scenarios/faults.hpp"

namespace wormdrive {
namespace {

std::string trimmed(std::string cell) {
  const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
  while (!cell.empty() && blank(cell.back())) cell.pop_back();
  cell.erase(0, static_cast<std::size_t>(std::find_if_not(cell.begin(), cell.end(), blank) - cell.begin()));
  return cell;
}

std::vector<std::string> split(const std::string& line) {
  std::vector<std::string> cells;
  std::stringstream stream(line);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(trimmed(cell));
  if (!line.empty() && line.back() == ',') cells.emplace_back();
  return cells;
}

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  ///< spreadsheets put it before the first name

/// Cells stand below the header, which is line 1.
std::uint32_t line_of(std::size_t row) { return static_cast<std::uint32_t>(row + 2); }

/// A cell as a finite number, with a sign if need be; no other text may stand in it.
std::optional<double> number(const std::string& cell) {
  const bool plus = cell.size() > 1 && cell[0] == '+' && cell[1] != '-';  // from_chars knows no plus sign
  const char* const end = cell.data() + cell.size();
  double value = 0.0;
  const auto [stop, error] = std::from_chars(cell.data() + (plus ? 1 : 0), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

Csv read_csv(const std::string& path) {
  std::string text = read_text(path);
  if (text.starts_with(byte_order_mark)) text.erase(0, byte_order_mark.size());
  if (const auto nul = std::find(text.begin(), text.end(), '\0'); nul != text.end())
    refuse({path, static_cast<std::uint32_t>(1 + std::count(text.begin(), nul, '\n'))},
           "a NUL byte; a CSV file is plain text");
  std::istringstream lines(text);
  Csv csv{path, {}, {}};
  std::string line;
  if (!std::getline(lines, line) || trimmed(line).empty()) refuse({path, 1}, "no header line with column names");
  csv.names = split(line);
  csv.columns.resize(csv.names.size());
  std::uint32_t empty_line = 0;  // tolerated at the end, where editors leave them
  for (std::uint32_t at = 2; std::getline(lines, line); ++at) {
    if (trimmed(line).empty()) {
      if (empty_line == 0) empty_line = at;
      continue;
    }
    if (empty_line != 0) refuse({path, empty_line}, "an empty line inside the table");
    const std::vector<std::string> cells = split(line);
    if (cells.size() != csv.names.size())
      refuse({path, at}, fmt::format("{} cells where the header has {}", cells.size(), csv.names.size()));
    for (std::size_t k = 0; k < cells.size(); ++k) csv.columns[k].push_back(cells[k]);
  }
  return csv;
}

const std::vector<std::string>& Csv::texts(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    refuse({path, 1}, fmt::format("no column '{}'; the header line names {}", name, fmt::join(names, ", ")));
  return columns[static_cast<std::size_t>(found - names.begin())];
}

std::vector<double> Csv::numbers(const std::string& name) const {
  std::vector<double> values;
  for (const std::string& cell : texts(name)) {
    const std::optional<double> value = number(cell);
    if (!value) refuse({path, line_of(values.size())}, fmt::format("{} = '{}' is not a finite number", name, cell));
    values.push_back(*value);
  }
  return values;
}

void require_increasing(const Csv& csv, const std::string& name, const std::vector<double>& values) {
  for (std::size_t k = 1; k < values.size(); ++k)
    if (!(values[k] > values[k - 1]))
      refuse({csv.path, line_of(k)}, fmt::format("{} = {} does not increase after {}", name, values[k], values[k - 1]));
}

}  // namespace wormdrive
