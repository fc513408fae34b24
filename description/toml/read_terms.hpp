#pragma once
#include <utility>

#include <fmt/format.h>

#include "description/toml/table_reader.hpp"
#include "description/variant_kinds.hpp"

namespace wormdrive {

/// Reads the terms of a sum, each table the alternative of a variant that its `kind` names; read(table, parameters)
/// reads one. path: what messages call them, with [k] behind it where they are several.
template <class Sum, class Read>
Sum read_terms(const std::vector<const toml::table*>& tables, const std::string& path, TableReader& parent,
               const std::vector<std::string>& kinds, Read&& read) {
  using Term = typename decltype(Sum::terms)::value_type;
  Sum sum;
  for (std::size_t k = 0; k < tables.size(); ++k) {
    const std::string name = tables.size() == 1 ? path : fmt::format("{}[{}]", path, k);
    TableReader table(tables[k], name, parent.axis(), parent.faults(), parent.where());
    const auto kind = table.choice("kind", kinds, Presence::required);
    if (!kind) continue;
    Term term = make_kind<Term>(*kind);
    std::visit([&](auto& parameters) { read(table, parameters); }, term);
    table.finish();
    sum.terms.push_back(std::move(term));
  }
  return sum;
}

}  // namespace wormdrive
