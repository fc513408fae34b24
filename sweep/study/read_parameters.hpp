#pragma once
#include <optional>
#include <vector>

#include "description/toml/table_reader.hpp"
#include "sweep/study/data_columns.hpp"
#include "sweep/study/study.hpp"

namespace wormdrive {

/// A parameter as it is stated, before the scenario is known.
struct StatedParameter {
  UncertainParameter parameter;  ///< without name and unit
  Location where;                ///< of its path
  std::optional<double> levels;
  std::string column;  ///< of the file of a design that is a table
};

/// Reads [[parameter]]; data: the files that they may name. in_table: the design is a table of their values, and they
/// have no distributions.
std::vector<StatedParameter> read_parameters(TableReader& root, DataColumns& data, bool in_table);

/// Reads [[correlation]] between parameters.
Copula read_correlations(TableReader& root, const std::vector<StatedParameter>& parameters);

/// A list of numbers; empty if it is not there, which is a fault if it has to be.
std::vector<double> read_list(TableReader& table, const std::string& key, Presence presence);

}  // namespace wormdrive
