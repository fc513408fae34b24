#pragma once
#include <optional>
#include <vector>

#include "scenarios/table_reader.hpp"
#include "sweep/study.hpp"

namespace wormdrive {

/// A parameter as it is stated, before the scenario is known.
struct StatedParameter {
  UncertainParameter parameter;  ///< without name and unit
  Location where;                ///< of its path
  std::optional<double> levels;
};

/// Reads [[parameter]].
std::vector<StatedParameter> read_parameters(TableReader& root);

/// Reads [[correlation]] between parameters.
Copula read_correlations(TableReader& root, const std::vector<StatedParameter>& parameters);

}  // namespace wormdrive
