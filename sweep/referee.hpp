#pragma once
#include <functional>
#include <vector>

#include "sweep/file/sweep_file.hpp"

namespace wormdrive {

/// Judges trials of a sweep that are done by CVODE, in an order that its seed decides, on several threads.
/// enough(): asked in turn before each whether those before it are enough.
std::vector<RefereeVerdict> referee(const SweepReader& sweep, unsigned threads, const std::function<bool()>& enough);

}  // namespace wormdrive
