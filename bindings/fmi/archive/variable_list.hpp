#pragma once
#include <optional>
#include <string>
#include <vector>

#include "bindings/fmi/fmu_model.hpp"

namespace wormdrive {

/// A variable of an FMU as its description states it, in the words that both versions of the standard share.
struct VariableInfo {
  std::string name;
  unsigned reference = 0;
  std::string causality;    ///< "output", "input", "local", "parameter", "independent"
  std::string variability;  ///< "continuous", "discrete", "fixed"
  std::string description;
  bool whole = false;  ///< an integer, else a real number
  std::string unit{};  ///< of SI; empty for a pure number
  std::optional<double> start{}, min{}, max{};
  std::string derivative_of{};  ///< name of the state
  /// Names of the variables that alone it may depend on; absent where that may be all.
  std::optional<std::vector<std::string>> depends_on{};
  bool sampled = false;  ///< changes with the controller's samples alone

  bool is_output() const { return causality == "output"; }
  bool is_rate() const { return !derivative_of.empty(); }
  bool is_calculated() const { return is_output() || causality == "local"; }
};

/// Every variable of an FMU, in the order in which its description counts them.
std::vector<VariableInfo> variables_of(const FmuModel& model);

}  // namespace wormdrive
