#pragma once
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "cli/report/page.hpp"

namespace wormdrive {

/// A text of the findings; empty for null.
std::string text(const nlohmann::json& value);

/// Adds the tables of diagnosis.json to the page: what changed, causes, evidence, gain, what the data can show.
void add_tables(ReportPage& page, const nlohmann::json& findings);

}  // namespace wormdrive
