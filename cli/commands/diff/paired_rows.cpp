#include "cli/commands/diff/paired_rows.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

namespace wormdrive {
namespace {

/// -1, 0 or 1: x stands before y, at the same place or behind it; what is not a number stands behind all numbers.
int order(double x, double y, double same) {
  if (std::isnan(x) || std::isnan(y)) return int{std::isnan(x)} - int{std::isnan(y)};
  if (x == y || std::abs(x - y) <= same) return 0;
  return x < y ? -1 : 1;
}

int order(const RowPlaces& a, std::size_t i, const RowPlaces& b, std::size_t j, const std::vector<double>& same) {
  for (std::size_t k = 0; k < a.numbers.size(); ++k)
    if (const int found = order(a.numbers[k][i], b.numbers[k][j], same[k]); found != 0) return found;
  for (std::size_t k = 0; k < a.texts.size(); ++k)
    if (const int found = a.texts[k][i].compare(b.texts[k][j]); found != 0) return found < 0 ? -1 : 1;
  return 0;
}

double span(const std::vector<double>& values) {
  double least = INFINITY, greatest = -INFINITY;
  for (const double value : values) {
    if (!std::isfinite(value)) continue;
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  return std::max(0.0, greatest - least);
}

}  // namespace

std::string in_words(const RowPlace& place) {
  std::string words;
  for (const auto& part : place) {
    if (!words.empty()) words += ", ";
    const double* const number = std::get_if<double>(&part);
    words += number ? fmt::format("{:.6g}", *number) : std::get<std::string>(part);
  }
  return words.empty() ? "-" : words;
}

RowPlace RowPlaces::operator[](std::size_t row) const {
  RowPlace place;
  for (const std::vector<double>& column : numbers) place.emplace_back(column[row]);
  for (const std::vector<std::string>& column : texts) place.emplace_back(column[row]);
  return place;
}

RowPlaces row_places(const ResultFile& file, const ComparedTable& table) {
  RowPlaces places;
  for (const std::string& name : table.over) places.numbers.push_back(file.column(table.name + "/" + name));
  for (const std::string& name : table.over_texts) places.texts.push_back(file.texts(table.name + "/" + name));
  const std::vector<std::string> columns = file.columns(table.name);
  if (places.numbers.empty() && places.texts.empty()) {
    std::vector<double> count(columns.empty() ? 0 : file.column(table.name + "/" + columns.front()).size());
    std::iota(count.begin(), count.end(), 0.0);
    places.numbers.push_back(std::move(count));
  }
  places.rows.resize(places.numbers.empty() ? places.texts.front().size() : places.numbers.front().size());
  std::iota(places.rows.begin(), places.rows.end(), std::size_t{0});
  if (std::find(columns.begin(), columns.end(), "status") != columns.end()) {
    const std::vector<double> status = file.column(table.name + "/status");
    std::erase_if(places.rows, [&](std::size_t row) { return status[row] == 0.0; });  // of a run that was not made yet
  }
  const std::vector<double> exactly(places.numbers.size(), 0.0);
  std::stable_sort(places.rows.begin(), places.rows.end(),
                   [&](std::size_t i, std::size_t j) { return order(places, i, places, j, exactly) < 0; });
  return places;
}

PairedRows paired_rows(const RowPlaces& a, const RowPlaces& b) {
  std::vector<double> same;
  for (std::size_t k = 0; k < a.numbers.size(); ++k)
    same.push_back(1e-12 * std::max(span(a.numbers[k]), span(b.numbers[k])));  // what rounding may come to
  PairedRows paired;
  auto i = a.rows.begin(), j = b.rows.begin();
  while (i != a.rows.end() && j != b.rows.end()) {
    const int found = order(a, *i, b, *j, same);
    if (found == 0)
      paired.common.emplace_back(*i++, *j++);
    else
      ++(found < 0 ? i : j);
  }
  paired.first_only = a.rows.size() - paired.common.size();
  paired.second_only = b.rows.size() - paired.common.size();
  return paired;
}

}  // namespace wormdrive
