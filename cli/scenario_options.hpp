#pragma once
#include <string>
#include <vector>

namespace wormdrive {

/// Options that every command which reads a scenario shares.
struct ScenarioOptions {
  std::string file;
  std::vector<std::string> overrides;  ///< --set table.key=value
  bool quiet = false;
  bool json = false;
  std::string command_line;  ///< as typed, for the result file
};

}  // namespace wormdrive
