#include "description/toml/read_signal.hpp"

#include "description/toml/read_pairs.hpp"
#include "description/toml/read_terms.hpp"

namespace wormdrive {
Samples read_samples(TableReader& table, std::string_view y_column, const std::string& folder) {
  const Pairs pairs = read_pairs(table,
                                 {{"times", unit::second},
                                  {"torques", unit::newton_metre},
                                  {"time", unit::second},
                                  {y_column, unit::newton_metre}},
                                 2, folder);
  Samples samples{pairs.x, pairs.y};
  table.read_choices(samples);
  return samples;
}

Signal read_signal(const std::vector<const toml::table*>& tables, const std::string& path, TableReader& parent,
                   const std::string& folder) {
  return read_terms<Signal>(tables, path, parent, kinds_of<SignalTerm>(), [&](TableReader& table, auto& parameters) {
    if constexpr (requires { parameters.times; })
      parameters = read_samples(table, "motor_torque", folder);
    else
      table.read_fields(parameters);
  });
}

}  // namespace wormdrive
