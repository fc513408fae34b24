#include "scenarios/read_reference.hpp"

#include <cmath>

#include <fmt/format.h>

#include "scenarios/read_pairs.hpp"
#include "scenarios/variant_kinds.hpp"

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

void require_whole(TableReader& table, const std::string& key, double value) {
  if (value != std::floor(value))
    table.fault(key, fmt::format("{} = {} must be a whole number", table.path_of(key), value));
}

Reference read_reference(TableReader& root, const std::string& folder) {
  Reference reference;
  const std::vector<const toml::table*> tables = root.tables("reference");
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const std::string name = tables.size() == 1 ? "reference" : fmt::format("reference[{}]", k);
    TableReader table(tables[k], name, root.axis(), root.faults(), root.where());
    const auto kind = table.choice("kind", kinds_of<ReferenceTerm>(), Presence::required);
    if (!kind) continue;
    ReferenceTerm term = make_kind<ReferenceTerm>(*kind);
    std::visit([&](auto& parameters) { read_term(table, parameters, folder); }, term);
    if (const auto* steps = std::get_if<RandomStepsReference>(&term)) require_whole(table, "seed", steps->seed);
    if (const auto* sines = std::get_if<MultisineReference>(&term)) require_whole(table, "count", sines->count);
    table.finish();
    reference.terms.push_back(std::move(term));
  }
  return reference;
}

}  // namespace wormdrive
