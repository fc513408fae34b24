#pragma once
#include "bench/contest.hpp"

namespace bench {

/// Prints what generality costs: fig. 9 by wormdrive and by a plain CVODE program, row for row.
void compare_generality(const Options& options);

}  // namespace bench
