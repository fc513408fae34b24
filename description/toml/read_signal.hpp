#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "core/signal.hpp"
#include "description/toml/table_reader.hpp"

namespace wormdrive {

/// The sum of the functions of time in these tables; CSV files are looked for in `folder`.
Signal read_signal(const std::vector<const toml::table*>& tables, const std::string& path, TableReader& parent,
                   const std::string& folder);
/// A torque over time from a table. y_column: what the CSV column holds, "motor_torque" or "load_torque".
Samples read_samples(TableReader& table, std::string_view y_column, const std::string& folder);

}  // namespace wormdrive
