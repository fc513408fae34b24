#pragma once
#include <cstdint>
#include <map>
#include <set>

#include "statistics/column.hpp"

namespace wormdrive {

/// The values that have certain ranks in a column, counted from 0 for the least: exact, in memory that does not grow
/// with the column. It is gone through three times where the values are spread, at most eight times. count: how many
/// values it has; every rank must be less. None may be not a number.
std::map<std::uint64_t, double> order_statistics(const Column& column, std::uint64_t count,
                                                 const std::set<std::uint64_t>& ranks);

}  // namespace wormdrive
