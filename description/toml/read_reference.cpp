#include "description/toml/read_reference.hpp"

#include <cmath>

#include <fmt/format.h>

#include "description/toml/read_pairs.hpp"
#include "description/toml/read_terms.hpp"

namespace wormdrive {
namespace {

template <class Parameters>
void read_term(TableReader& table, Parameters& parameters, const std::string&) {
  table.read_fields(parameters);
  if constexpr (requires { parameters.seed; }) require_whole(table, "seed", parameters.seed);
  if constexpr (requires { parameters.count; }) require_whole(table, "count", parameters.count);
}
void read_term(TableReader& table, TableReference& reference, const std::string& folder) {
  const Pairs pairs = read_pairs(
      table,
      {{"times", unit::second}, {"angles", unit::radian}, {"time", unit::second}, {"gear_angle", unit::radian}, 4},
      folder);
  if (!pairs.x.empty()) reference.table = CubicTable(pairs.x, pairs.y);
}

}  // namespace

void require_whole(TableReader& table, const std::string& key, double value) {
  if (value != std::floor(value)) table.fault(key, fmt::format("{} = {} {}", table.path_of(key), value, must_be_whole));
}

Reference read_reference(TableReader& root, const std::string& folder) {
  return read_terms<Reference>(root.tables("reference"), "reference", root, kinds_of<ReferenceTerm>(),
                               [&](TableReader& table, auto& parameters) { read_term(table, parameters, folder); });
}

}  // namespace wormdrive
