#include "description/toml/read_load.hpp"

#include <type_traits>
#include <utility>

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
        if constexpr (std::is_same_v<Load, GravityArm>) check_together(table, load);
      });
  return load_of(std::move(sum.terms));
}

}  // namespace wormdrive
