#pragma once
#include <functional>
#include <vector>

#include "sweep/file/sweep_file.hpp"

namespace wormdrive {

/// Judges trials of a sweep that are done by CVODE, in an order that its seed decides, on several threads.
/// enough(count): asked before each, in turn, whether that many are enough.
std::vector<RefereeVerdict> referee(const SweepReader& sweep, unsigned threads,
                                    const std::function<bool(std::size_t)>& enough);

}  // namespace wormdrive
