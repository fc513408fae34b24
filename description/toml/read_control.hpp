#pragma once
#include <string>

#include "description/scenario.hpp"
#include "description/toml/table_reader.hpp"

namespace wormdrive {

/// Reads [controller], [reference], [sensor], [disturbance] and [metrics] into a scenario whose other tables are
/// already read; without [controller] none of the others may stand. CSV files are looked for in `folder`.
void read_control(TableReader& root, Scenario& scenario, const std::string& folder);

}  // namespace wormdrive
