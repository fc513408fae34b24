#pragma once
#include <filesystem>
#include <string>

#include <fmt/format.h>

#include "description/diagnostics.hpp"
#include "output/replacing.hpp"

namespace wormdrive {

/// Throws InputFault if writing the output, or its part, would destroy the file that the command reads.
inline void reject_overwriting(const std::string& output, const std::string& input) {
  for (const std::string& written : {output, followed(output) + ".part"})
    if (std::error_code none; std::filesystem::equivalent(written, input, none))
      reject({output}, fmt::format("the result would overwrite {}; choose another --output", input));
}

}  // namespace wormdrive
