#pragma once
#include <string>

#include <toml++/toml.h>

namespace wormdrive {

/// Applies "path.to.key=value" or "path.to[1].key=value" to a document; what it inserts has "--set path.to.key=value"
/// as its origin. Tables that are missing on the way are made. Throws InputFault.
void apply_override(toml::table& root, const std::string& assignment);

}  // namespace wormdrive
