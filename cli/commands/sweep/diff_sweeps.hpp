#pragma once
#include "cli/commands.hpp"

namespace wormdrive {

/// Whether a file holds trials of a sweep, finished or not.
bool is_sweep(const std::string& path);

/// Compares two sweeps trial by trial and prints which trials and columns differ; 0 where they agree, 1 where they
/// differ. Throws InputFault if one is none.
int diff_sweeps(const DiffOptions& options);

}  // namespace wormdrive
