#pragma once
#include <optional>
#include <vector>

#include "description/toml/table_reader.hpp"
#include "sweep/study/study.hpp"

namespace wormdrive {

/// Reads [sweep], design and seed, into a study whose parameters are known; levels: those that parameters state.
void read_design(TableReader& table, Study& study, const std::vector<std::optional<double>>& levels);

}  // namespace wormdrive
