#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "statistics/column.hpp"

namespace wormdrive {

/// Calls visit(number, values) for every block of so many values of a column; the last one, if it is cut off, is none.
template <class Visit>
void for_each_block(const Column& column, std::uint64_t size, Visit&& visit) {
  std::vector<double> values;
  std::uint64_t number = 0;
  column([&](std::span<const double> part) {
    for (const double value : part) {
      values.push_back(value);
      if (values.size() < size) continue;
      visit(number++, values);
      values.clear();
    }
  });
}

/// Whether a block has all its values.
inline bool is_whole(const std::vector<double>& values) {
  return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

}  // namespace wormdrive
