#pragma once
#include <string>
#include <vector>

#include "sweep/sweep_file.hpp"

namespace wormdrive {

/// Writes the sweep of which the files are the shards, given in any order, and returns its number of trials. Throws
/// InputFault if one belongs to another sweep, is not complete, is given twice or is missing.
std::uint64_t merge_shards(const std::vector<std::string>& paths, const std::string& output,
                           const std::string& command_line);

}  // namespace wormdrive
