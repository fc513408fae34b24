#pragma once
#include <cstdint>
#include <map>
#include <set>

#include "sweep/column.hpp"

namespace wormdrive {

/// The values that have certain ranks in a column, counted from 0 for the least: exact, in memory that does not grow with
/// the column, which is gone through six times. Every rank must be less than the number of values; none may be not a
/// number.
std::map<std::uint64_t, double> order_statistics(const Column& column, const std::set<std::uint64_t>& ranks);

}  // namespace wormdrive
