#include "description/toml/read_signal.hpp"

#include "description/toml/read_pairs.hpp"
#include "description/toml/read_terms.hpp"

namespace wormdrive {
namespace {

/// y_column: what the CSV column holds, "motor_torque" or "load_torque".
Samples read_samples(TableReader& table, std::string_view y_column, const std::string& folder) {
  const Pairs pairs = read_pairs(table,
                                 {{"times", unit::second},
                                  {"torques", unit::newton_metre},
                                  {"time", unit::second},
                                  {y_column, unit::newton_metre},
                                  2},
                                 folder);
  const auto interpolation = table.choice("interpolation", {"hold", "linear"}, Presence::optional);
  return {pairs.x, pairs.y, interpolation == "linear" ? Interpolation::linear : Interpolation::hold};
}

}  // namespace

Signal read_signal(const std::vector<const toml::table*>& tables, const std::string& path, TableReader& parent,
                   const std::string& folder, const std::vector<std::string>& other_kinds) {
  std::vector<std::string> kinds = kinds_of<SignalTerm>();
  kinds.insert(kinds.end(), other_kinds.begin(), other_kinds.end());
  return read_terms<Signal>(tables, path, parent, kinds, [&](TableReader& table, auto& parameters) {
    if constexpr (requires { parameters.times; })
      parameters = read_samples(table, path == "load" ? "load_torque" : "motor_torque", folder);
    else
      table.read_fields(parameters);
  });
}

}  // namespace wormdrive
