#include "description/toml/read_reference.hpp"

#include "description/toml/read_pairs.hpp"
#include "description/toml/read_terms.hpp"

namespace wormdrive {

Reference read_reference(TableReader& root, const std::string& folder) {
  return read_terms<Reference>(root.tables("reference"), "reference", root, kinds_of<ReferenceTerm>(),
                               [&]<class Term>(TableReader& table, Term& term) {
                                 if constexpr (requires { Term::fields(); }) table.read_fields(term);
                                 read_table(table, term, folder);
                               });
}

}  // namespace wormdrive
