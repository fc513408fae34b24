#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "output/hdf5/output_lock.hpp"
#include "output/replacing.hpp"

namespace wormdrive {

/// Writes the sweep of which the files are the shards, given in any order, and returns its number of trials. Throws
/// InputFault if one belongs to another sweep, lacks trials, is given twice or is missing, OutputFault if what is there
/// may not be replaced. lock: of the output; early_end: of a sweep that ends early, the first
/// trial that it does not take.
std::uint64_t merge_shards(const std::vector<std::string>& paths, const std::string& output, OutputLock lock,
                           const std::string& command_line, Replace replace = Replace::same_kind,
                           std::optional<std::uint64_t> early_end = {});

}  // namespace wormdrive
