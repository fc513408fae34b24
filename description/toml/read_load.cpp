#include "description/toml/read_load.hpp"

#include <optional>
#include <type_traits>

#include "description/toml/read_pairs.hpp"
#include "description/toml/read_signal.hpp"

namespace wormdrive {
namespace {

AngleTable read_table(TableReader& table, const std::string& folder) {
  const Pairs pairs = read_pairs(table,
                                 {{"angles", unit::degrees},
                                  {"torques", unit::newton_metre},
                                  {"gear_angle", unit::radian},
                                  {"load_torque", unit::newton_metre},
                                  4},
                                 folder);
  return {pairs.x, pairs.y};
}

/// An arm turns; every other load fits a linear axis too.
template <class Load>
bool is_offered(Axis axis) {
  return axis == Axis::rotary || !std::is_same_v<Load, GravityArm>;
}

/// What the keys of a load must fulfil together.
template <class Load>
void check_together(TableReader&, const Load&) {}
void check_together(TableReader& table, const GravityArm&) {
  if (table.has("torque_Nm") && (table.has("mass_kg") || table.has("arm_m")))
    table.fault("torque_Nm",
                "load.torque_Nm is stated along with mass_kg or arm_m; keep the torque, or the two others");
  else if (!table.has("torque_Nm") && !(table.has("mass_kg") && table.has("arm_m")))
    table.lacks("'torque_Nm', or 'mass_kg' and 'arm_m'");
}

/// The load of this table, or nothing if it is a function of time.
std::optional<LoadParameters> read_special(TableReader& table, const std::string& folder) {
  const auto kind = table.peek("kind");
  std::optional<LoadParameters> stated;
  for_each_load([&]<class Load>() {
    if (kind != Load::kind || !is_offered<Load>(table.axis())) return;
    table.text("kind");
    Load load;
    if constexpr (requires { Load::fields(); })
      table.read_fields(load);
    else
      load = read_table(table, folder);
    table.finish();
    check_together(table, load);
    stated = load;
  });
  return stated;
}

}  // namespace

LoadParameters read_load(TableReader& root, const std::string& folder) {
  const std::vector<const toml::table*> tables = root.tables("load");
  if (tables.size() != 1) return read_signal(tables, "load", root, folder);
  TableReader load(tables.front(), "load", root.axis(), root.faults(), root.where());
  if (const auto special = read_special(load, folder)) return *special;
  std::vector<std::string> kinds;
  for_each_load([&]<class Load>() {
    if (is_offered<Load>(root.axis())) kinds.emplace_back(Load::kind);
  });
  return read_signal(tables, "load", root, folder, kinds);
}

}  // namespace wormdrive
