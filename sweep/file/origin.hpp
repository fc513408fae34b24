#pragma once
#include <string>
#include <string_view>

#include "sweep/study/study.hpp"

namespace wormdrive {

/// What the rows of a file hang on.
struct Origin {
  std::string study, scenario;  ///< TOML
  std::string build;            ///< program_identity()
};
Origin origin_of(const Study& study);

/// Why rows of one origin cannot stand beside those of another one: study, scenario or program differ. Empty if they
/// can. whose_build: what the program of here is said to be.
std::string why_not_beside(const Origin& there, const Origin& here, std::string_view whose_build = "this program is");

}  // namespace wormdrive
