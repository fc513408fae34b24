#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace wormdrive {

/// Writes the sweep of which the files are the shards, given in any order, and returns its number of trials. Throws
/// InputFault if one belongs to another sweep, lacks trials, is given twice or is missing.
std::uint64_t merge_shards(const std::vector<std::string>& paths, const std::string& output,
                           const std::string& command_line);

}  // namespace wormdrive
