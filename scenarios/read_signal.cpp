#include "scenarios/read_signal.hpp"

#include <fmt/format.h>

#include "scenarios/read_pairs.hpp"
#include "scenarios/variant_kinds.hpp"

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
  Signal signal;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const std::string name = tables.size() == 1 ? path : fmt::format("{}[{}]", path, k);
    TableReader table(tables[k], name, parent.axis(), parent.faults(), parent.where());
    const auto kind = table.choice("kind", kinds, Presence::required);
    if (!kind) continue;
    SignalTerm term = make_kind<SignalTerm>(*kind);
    std::visit(
        [&](auto& parameters) {
          if constexpr (requires { parameters.times; })
            parameters = read_samples(table, path == "load" ? "load_torque" : "motor_torque", folder);
          else
            table.read_fields(parameters);
        },
        term);
    table.finish();
    signal.terms.push_back(term);
  }
  return signal;
}

}  // namespace wormdrive
