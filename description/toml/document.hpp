#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <toml++/toml.h>

#include "description/diagnostics.hpp"

namespace wormdrive {

/// Why a file cannot be read, as for its name ("cannot be read: Permission denied"); nothing if it can.
std::optional<std::string> why_unreadable(const std::string& path);

/// Text of a file; throws InputFault if it cannot be read.
std::string read_text(const std::string& path);

/// Parses TOML text and applies overrides "path.to.key=value"; throws InputFault with line and column.
/// Every node keeps its origin: `name` for the text, "--set path.to.key=value" for an override.
toml::table parse_document(std::string_view text, const std::string& name, const std::vector<std::string>& overrides);

Location location(const toml::source_region& region);

}  // namespace wormdrive
