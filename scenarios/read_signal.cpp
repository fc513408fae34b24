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

/// A quantity as a table or a CSV file names it.
struct Name {
  std::string_view stem;
  Unit unit;
  std::string spelled(Axis axis) const { return spellings(stem, unit, axis).front().key; }
};

/// x and y of a table, inline as arrays or from a CSV file; angles and times must increase. Faults leave it empty.
struct PairSource {
  Name x, y;                ///< the inline arrays
  Name x_column, y_column;  ///< the columns of the file, unless it is said otherwise
  std::size_t at_least;
};

std::string count(std::size_t number, const std::string& things) {
  return fmt::format("{} {}{}", number, things, number == 1 ? "" : "s");
}

Pairs from_file(TableReader& table, const PairSource& source, const std::string& file, const std::string& folder) {
  const std::string x_column = table.text("x_column").value_or(source.x_column.spelled(table.axis()));
  const std::string y_column = table.text("y_column").value_or(source.y_column.spelled(table.axis()));
  for (const Name& name : {source.x, source.y})
    if (const auto both = table.stated(name.stem, name.unit))
      table.fault(both->key, fmt::format("{} is stated along with 'file'; keep one", table.path_of(both->key)));
  const std::string stated = fmt::format("{} = \"{}\"", table.path_of("file"), file);
  try {
    const Csv csv = read_csv((std::filesystem::path(folder) / file).string());
    const Pairs pairs{csv.numbers(x_column), csv.numbers(y_column)};
    require_increasing(csv, x_column, pairs.x);
    if (pairs.x.size() >= source.at_least) return pairs;
    table.fault("file", fmt::format("{} has {} below its header line; at least {} are needed", stated,
                                    count(pairs.x.size(), "row"), source.at_least));
  } catch (const InputFault& fault) {
    // A wrong line is put right in the file, a wrong name in the scenario.
    for (const Fault& f : fault.faults)
      if (f.where.line > 0)
        table.faults().add(f.where, fmt::format("{} ({} at {})", f.what, table.path_of("file"),
                                                to_string(table.where("file"))));
      else
        table.fault("file", fmt::format("{} {}", stated, f.what));
  }
  return {};
}

Pairs inline_pairs(TableReader& table, const PairSource& source) {
  const auto x_key = table.stated(source.x.stem, source.x.unit), y_key = table.stated(source.y.stem, source.y.unit);
  if (!x_key || !y_key) {
    table.lacks(fmt::format("'file' (a CSV file), or '{}' and '{}'", source.x.spelled(table.axis()),
                            source.y.spelled(table.axis())));
    return {};
  }
  const auto x = table.numbers(*x_key), y = table.numbers(*y_key);
  if (!x || !y) return {};
  const std::string path = table.path_of(x_key->key);
  if (x->size() != y->size()) {
    table.fault(x_key->key, fmt::format("{} has {} but {} has {}", path, count(x->size(), "value"), y_key->key,
                                        count(y->size(), "value")));
    return {};
  }
  if (x->size() < source.at_least) {
    table.fault(x_key->key, fmt::format("{} has {}; at least {} are needed", path, count(x->size(), "value"),
                                        source.at_least));
    return {};
  }
  for (std::size_t k = 1; k < x->size(); ++k) {
    if ((*x)[k] > (*x)[k - 1]) continue;
    const double si = x_key->unit.si;
    table.fault(x_key->key, fmt::format("{}[{}] = {:.12g} does not increase after {:.12g}", path, k, (*x)[k] / si,
                                        (*x)[k - 1] / si));
    return {};
  }
  return {*x, *y};
}

Pairs read_pairs(TableReader& table, const PairSource& source, const std::string& folder) {
  if (!table.has("file")) return inline_pairs(table, source);
  const auto file = table.text("file");
  return file ? from_file(table, source, *file, folder) : Pairs{};
}

/// y_column: what the CSV column holds, "motor_torque" or "load_torque".
Samples read_samples(TableReader& table, std::string_view y_column, const std::string& folder) {
  const Pairs pairs = read_pairs(table,
                                 {{"times", unit::second}, {"torques", unit::newton_metre},
                                  {"time", unit::second}, {y_column, unit::newton_metre}, 2},
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
    TableReader table(tables[k], name, parent.axis(), parent.faults(), parent.where());
    std::vector<std::string> words = signal_kinds();
    if (path == "load" && tables.size() == 1) {
      if (parent.axis() == Axis::rotary) words.emplace_back(GravityArm::kind);
      words.emplace_back(AngleTable::kind);
    }
    const auto kind = table.choice("kind", words, Presence::required);
    if (!kind) continue;
    SignalTerm term = make_term(*kind);
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

std::optional<LoadParameters> read_special_load(TableReader& table, const std::string& folder) {
  const auto kind = table.peek("kind");
  if (kind == GravityArm::kind && table.axis() == Axis::rotary) {
    table.text("kind");
    GravityArm arm;
    table.read_fields(arm);
    table.finish();
    if (table.has("torque_Nm") && (table.has("mass_kg") || table.has("arm_m")))
      table.fault("torque_Nm", "load.torque_Nm is stated along with mass_kg or arm_m; keep the torque, or the two others");
    else if (!table.has("torque_Nm") && !(table.has("mass_kg") && table.has("arm_m")))
      table.lacks("'torque_Nm', or 'mass_kg' and 'arm_m'");
    return arm;
  }
  if (kind == AngleTable::kind) {
    table.text("kind");
    const Pairs pairs = read_pairs(table,
                                   {{"angles", unit::degrees}, {"torques", unit::newton_metre},
                                    {"gear_angle", unit::radian}, {"load_torque", unit::newton_metre}, 4},
                                   folder);
    table.finish();
    return AngleTable{pairs.x, pairs.y};
  }
  return std::nullopt;
}

}  // namespace wormdrive
