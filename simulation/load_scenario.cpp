#include "simulation/load_scenario.hpp"

#include "description/toml/document.hpp"
#include "output/run_file.hpp"

namespace wormdrive {

Scenario load_scenario(const std::string& path, const std::vector<std::string>& overrides, Purpose purpose) {
  if (!is_hdf5(path)) return parse_scenario(read_text(path), path, overrides, purpose);
  try {
    return parse_scenario(read_stored_scenario(path), path, overrides, purpose);
  } catch (const OutputFault& fault) {
    reject({path}, fault.what());
  }
}

}  // namespace wormdrive
