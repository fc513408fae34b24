#pragma once
#include <vector>

#include "description/toml/table_reader.hpp"
#include "sweep/study/data_columns.hpp"
#include "sweep/study/read_parameters.hpp"
#include "sweep/study/study.hpp"

namespace wormdrive {

/// Reads [sweep], design and seed, into a study whose parameters are known, as they are stated; data: the files that it
/// may name.
void read_design(TableReader& table, Study& study, const std::vector<StatedParameter>& stated, DataColumns& data);

}  // namespace wormdrive
