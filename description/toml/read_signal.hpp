#pragma once
#include <string>
#include <vector>

#include "core/signal.hpp"
#include "description/toml/table_reader.hpp"

namespace wormdrive {

/// The sum of the functions of time in these tables; CSV files are looked for in `folder`. A message about an unknown
/// kind names `other_kinds` too, which the caller reads.
Signal read_signal(const std::vector<const toml::table*>& tables, const std::string& path, TableReader& parent,
                   const std::string& folder, const std::vector<std::string>& other_kinds = {});

}  // namespace wormdrive
