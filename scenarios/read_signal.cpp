#include "scenarios/read_signal.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "scenarios/csv.hpp"

namespace wormdrive {
namespace {

/// Two columns of equal length.
struct Pairs {
  std::vector<double> x, y;
};

/// x and y of a table, inline as arrays or from a CSV file; angles and times must increase. Faults leave it empty.
struct PairSource {
  std::string x_name, y_name;          ///< names of the inline arrays without unit
  Unit x_unit, y_unit;
  std::string x_column, y_column;      ///< default columns of the file
  std::size_t at_least;
};

Pairs from_file(TableReader& table, const PairSource& source, const std::string& file, const std::string& folder) {
  const std::string x_column = table.text("x_column").value_or(source.x_column);
  const std::string y_column = table.text("y_column").value_or(source.y_column);
  const Csv csv = read_csv((std::filesystem::path(folder) / file).string());
  const Pairs pairs{csv.numbers(x_column), csv.numbers(y_column)};
  require_increasing(csv, x_column, pairs.x);
  if (pairs.x.size() < source.at_least)
    table.fault("file", fmt::format("{} has {} rows; at least {} are needed", csv.path, pairs.x.size(), source.at_least));
  return pairs;
}

Pairs inline_pairs(TableReader& table, const PairSource& source) {
  const auto x = table.numbers(source.x_name, source.x_unit), y = table.numbers(source.y_name, source.y_unit);
  const std::string x_key = spellings(source.x_name, source.x_unit, table.axis()).front().key;
  const std::string y_key = spellings(source.y_name, source.y_unit, table.axis()).front().key;
  if (!x || !y) {
    if (!table.has(x_key) || !table.has(y_key))
      table.fault("file", fmt::format("{} lacks 'file' (a CSV file), or '{}' and '{}'", table.path_of(""), x_key, y_key));
    return {};
  }
  if (x->size() != y->size() || x->size() < source.at_least) {
    table.fault(x_key, fmt::format("{} has {} values and {} has {}; both need the same number, at least {}", x_key,
                                   x->size(), y_key, y->size(), source.at_least));
    return {};
  }
  for (std::size_t k = 1; k < x->size(); ++k) {
    if ((*x)[k] > (*x)[k - 1]) continue;
    table.fault(x_key, fmt::format("{}[{}] = {} does not increase after {}", table.path_of(x_key), k,
                                   (*x)[k] / source.x_unit.si, (*x)[k - 1] / source.x_unit.si));
    return {};
  }
  return {*x, *y};
}

Pairs read_pairs(TableReader& table, const PairSource& source, const std::string& folder) {
  const auto file = table.text("file");
  if (!file) return inline_pairs(table, source);
  try {
    return from_file(table, source, *file, folder);
  } catch (const InputFault& fault) {
    table.faults().add(table.where("file"), fault.what());
    return {};
  }
}

Samples read_samples(TableReader& table, const std::string& folder) {
  const bool linear_axis = table.axis() == Axis::linear;
  const Pairs pairs = read_pairs(table,
                                 {"times", "torques", unit::second, unit::newton_metre, "time_s",
                                  linear_axis ? "motor_force_N" : "motor_torque_Nm", 2},
                                 folder);
  const auto interpolation = table.choice("interpolation", {"hold", "linear"}, Presence::optional);
  return {pairs.x, pairs.y, interpolation == "linear" ? Interpolation::linear : Interpolation::hold};
}

/// The names of all functions of time, in the order of their list.
template <std::size_t... K>
std::vector<std::string> kinds(std::index_sequence<K...>) {
  return {std::string(std::variant_alternative_t<K, SignalTerm>::kind)...};
}

/// The alternative of the given kind, with default parameters.
template <std::size_t K = 0>
SignalTerm make_term(const std::string& kind) {
  if constexpr (K + 1 < std::variant_size_v<SignalTerm>)
    if (kind != std::variant_alternative_t<K, SignalTerm>::kind) return make_term<K + 1>(kind);
  return std::variant_alternative_t<K, SignalTerm>{};
}

std::vector<std::string> signal_kinds() { return kinds(std::make_index_sequence<std::variant_size_v<SignalTerm>>()); }

}  // namespace

Signal read_signal(const std::vector<const toml::table*>& tables, const std::string& path, TableReader& parent,
                   const std::string& folder) {
  Signal signal;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const std::string name = tables.size() == 1 ? path : fmt::format("{}[{}]", path, k);
    TableReader table(*tables[k], name, parent.axis(), parent.faults(), parent.where());
    std::vector<std::string> words = signal_kinds();
    if (path == "load" && tables.size() == 1)
      for (const std::string_view special : {GravityArm::kind, AngleTable::kind}) words.emplace_back(special);
    const auto kind = table.choice("kind", words, Presence::required);
    if (!kind) continue;
    SignalTerm term = make_term(*kind);
    std::visit(
        [&](auto& parameters) {
          if constexpr (requires { parameters.times; })
            parameters = read_samples(table, folder);
          else
            table.read_fields(parameters);
        },
        term);
    table.refuse_unknown_keys();
    signal.terms.push_back(term);
  }
  return signal;
}

std::optional<LoadParameters> read_special_load(TableReader& table, const std::string& folder) {
  const auto kind = table.peek("kind");
  if (kind == GravityArm::kind) {
    table.text("kind");
    GravityArm arm;
    table.read_fields(arm);
    table.refuse_unknown_keys();
    if (arm.amplitude ? arm.mass || arm.arm : !(arm.mass && arm.arm))
      table.fault("kind", "load of kind \"gravity_arm\" needs either 'torque_Nm', or both 'mass_kg' and 'arm_m'");
    return arm;
  }
  if (kind == AngleTable::kind) {
    table.text("kind");
    const Pairs pairs = read_pairs(
        table, {"angles", "torques", unit::degrees, unit::newton_metre, "gear_angle_rad", "load_torque_Nm", 4}, folder);
    table.refuse_unknown_keys();
    return AngleTable{pairs.x, pairs.y};
  }
  return std::nullopt;
}

}  // namespace wormdrive
