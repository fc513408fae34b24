#pragma once
#include <optional>
#include <string>
#include <vector>

#include "core/load.hpp"
#include "scenarios/table_reader.hpp"

namespace wormdrive {

/// The sum of the functions of time in these tables; CSV files are looked for in `folder`.
Signal read_signal(const std::vector<const toml::table*>& tables, const std::string& path, TableReader& parent,
                   const std::string& folder);

/// A load that is not a function of time, or nothing if the table states one.
std::optional<LoadParameters> read_special_load(TableReader& table, const std::string& folder);

}  // namespace wormdrive
