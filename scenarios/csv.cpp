#include "scenarios/csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>

#include "scenarios/document.hpp"
#include "scenarios/faults.hpp"

namespace wormdrive {
namespace {

[[noreturn]] void fail(const std::string& path, std::size_t line, const std::string& what) {
  Faults faults;
  faults.add({path, static_cast<std::uint32_t>(line)}, what);
  faults.raise();
  throw std::logic_error("a fault was added");
}

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

/// Cells stand below the header, which is line 1.
std::size_t line_of(std::size_t row) { return row + 2; }

}  // namespace

Csv read_csv(const std::string& path) {
  const std::string text = read_text(path);
  if (text.find('\0') != std::string::npos) fail(path, 0, "a NUL byte; a CSV file is plain text");
  std::istringstream lines(text);
  Csv csv{path, {}, {}};
  std::string line;
  if (!std::getline(lines, line) || trimmed(line).empty()) fail(path, 1, "no header line with column names");
  csv.names = split(line);
  csv.columns.resize(csv.names.size());
  std::size_t empty_line = 0;  // tolerated at the end, where editors leave them
  for (std::size_t number = 2; std::getline(lines, line); ++number) {
    if (trimmed(line).empty()) {
      if (empty_line == 0) empty_line = number;
      continue;
    }
    if (empty_line != 0) fail(path, empty_line, "an empty line inside the table");
    const std::vector<std::string> cells = split(line);
    if (cells.size() != csv.names.size())
      fail(path, number, fmt::format("{} cells where the header has {}", cells.size(), csv.names.size()));
    for (std::size_t k = 0; k < cells.size(); ++k) csv.columns[k].push_back(cells[k]);
  }
  return csv;
}

const std::vector<std::string>& Csv::texts(const std::string& name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  if (found == names.end())
    fail(path, 1, fmt::format("no column '{}'; the columns are {}", name, fmt::join(names, ", ")));
  return columns[static_cast<std::size_t>(found - names.begin())];
}

std::vector<double> Csv::numbers(const std::string& name) const {
  std::vector<double> values;
  for (const std::string& cell : texts(name)) {
    double value = 0.0;
    const char* const end = cell.data() + cell.size();
    const auto [stop, error] = std::from_chars(cell.data(), end, value);
    if (error != std::errc() || stop != end || !std::isfinite(value))
      fail(path, line_of(values.size()), fmt::format("{} = '{}' is not a finite number", name, cell));
    values.push_back(value);
  }
  return values;
}

void require_increasing(const Csv& csv, const std::string& name, const std::vector<double>& values) {
  for (std::size_t k = 1; k < values.size(); ++k)
    if (!(values[k] > values[k - 1]))
      fail(csv.path, line_of(k), fmt::format("{} = {} does not increase after {}", name, values[k], values[k - 1]));
}

}  // namespace wormdrive
