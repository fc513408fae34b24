#include "description/toml/read_reference.hpp"

#include "description/toml/read_pairs.hpp"
#include "description/toml/read_terms.hpp"

namespace wormdrive {
namespace {

template <class Parameters>
void read_term(TableReader& table, Parameters& parameters, const std::string&) {
  table.read_fields(parameters);
}
void read_term(TableReader& table, TableReference& reference, const std::string& folder) {
  const Pairs pairs = read_pairs(
      table,
      {{"times", unit::second}, {"angles", unit::radian}, {"time", unit::second}, {"gear_angle", unit::radian}, 4},
      folder);
  if (!pairs.x.empty()) reference.table = CubicTable(pairs.x, pairs.y);
}

}  // namespace

Reference read_reference(TableReader& root, const std::string& folder) {
  return read_terms<Reference>(root.tables("reference"), "reference", root, kinds_of<ReferenceTerm>(),
                               [&](TableReader& table, auto& parameters) { read_term(table, parameters, folder); });
}

}  // namespace wormdrive
