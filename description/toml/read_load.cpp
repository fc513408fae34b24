#include "description/toml/read_load.hpp"

#include <algorithm>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "description/toml/read_pairs.hpp"
#include "description/toml/read_signal.hpp"
#include "description/toml/read_terms.hpp"

namespace wormdrive {
namespace {

/// An arm turns; every other load fits a linear axis too.
template <class Load>
bool is_offered(Axis axis) {
  return axis == Axis::rotary || !std::is_same_v<Load, GravityArm>;
}

/// What the keys of a load must fulfil together.
void check_together(TableReader& table, const GravityArm&) {
  if (table.has("torque_Nm") && (table.has("mass_kg") || table.has("arm_m")))
    table.fault("torque_Nm", fmt::format("{} is stated along with mass_kg or arm_m; keep the torque, or the two others",
                                         table.path_of("torque_Nm")));
  else if (!table.has("torque_Nm") && !(table.has("mass_kg") && table.has("arm_m")))
    table.lacks("'torque_Nm', or 'mass_kg' and 'arm_m'");
}
void check_together(TableReader& table, const EndStops& stops) {
  const auto keys = [&](std::string_view name) { return spellings(name, unit::degrees, table.axis()); };
  const auto stated = [&](const Spelling& key) { return table.has(key.key); };
  const std::vector<Spelling> low = keys("angle_low"), high = keys("angle_high");
  if (std::none_of(low.begin(), low.end(), stated) && std::none_of(high.begin(), high.end(), stated))
    return table.lacks(fmt::format("'{}' or '{}'", low.front().key, high.front().key));
  if (!stops.low || !stops.high || *stops.low < *stops.high) return;
  const std::string key = std::find_if(high.begin(), high.end(), stated)->key;
  table.fault(key, fmt::format("{} must be greater than {}", table.path_of(key),
                               std::find_if(low.begin(), low.end(), stated)->key));
}

}  // namespace

LoadParameters read_load(TableReader& root, const std::string& folder) {
  std::vector<std::string> kinds = kinds_of<SignalTerm>();
  for_each_load([&]<class Load>() {
    if (is_offered<Load>(root.axis())) kinds.emplace_back(Load::kind);
  });
  LoadSum sum =
      read_terms<LoadSum>(root.tables("load"), "load", root, kinds, [&]<class Load>(TableReader& table, Load& load) {
        if constexpr (std::is_same_v<Load, Samples>)
          load = read_samples(table, "load_torque", folder);
        else
          read_parameters(table, load, folder);
        if constexpr (requires { check_together(table, load); }) check_together(table, load);
      });
  return load_of(std::move(sum.terms));
}

}  // namespace wormdrive
