#include "cli/report/thinning.hpp"

#include <algorithm>
#include <cmath>

namespace wormdrive {
namespace {

constexpr std::size_t stretches = 2000;  ///< of a long table: a screen has fewer pixels

/// Adds the rows of [begin, end) where a column is largest, smallest and first not a number.
void add_extremes(const std::vector<double>& column, std::size_t begin, std::size_t end,
                  std::vector<std::size_t>& rows) {
  std::size_t low = end, high = end, gap = end;
  for (std::size_t k = begin; k < end; ++k) {
    if (std::isnan(column[k])) {
      gap = std::min(gap, k);
      continue;
    }
    if (low == end || column[k] < column[low]) low = k;
    if (high == end || column[k] > column[high]) high = k;
  }
  for (const std::size_t row : {low, high, gap})
    if (row != end) rows.push_back(row);
}

}  // namespace

std::vector<std::size_t> rows_with_extremes(const std::vector<const std::vector<double>*>& columns) {
  const std::size_t count = columns.front()->size(), each = count / stretches;
  std::vector<std::size_t> rows;
  if (each < 4) {
    for (std::size_t k = 0; k < count; ++k) rows.push_back(k);
    return rows;
  }
  for (const std::vector<double>* column : columns)
    for (std::size_t begin = 0; begin < count; begin += each)
      add_extremes(*column, begin, std::min(begin + each, count), rows);
  rows.insert(rows.end(), {0, count - 1});
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

std::vector<std::size_t> even_rows(std::size_t rows, std::size_t wanted) {
  std::vector<std::size_t> list;
  if (rows <= wanted) {
    for (std::size_t k = 0; k < rows; ++k) list.push_back(k);
    return list;
  }
  for (std::size_t k = 0; k < wanted; ++k) list.push_back(k * (rows - 1) / (wanted - 1));
  return list;
}

}  // namespace wormdrive
