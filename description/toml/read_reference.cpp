#include "description/toml/read_reference.hpp"

#include "description/toml/read_pairs.hpp"
#include "description/toml/read_terms.hpp"

namespace wormdrive {

Reference read_reference(TableReader& root, const std::string& folder) {
  return read_terms<Reference>(root.tables("reference"), "reference", root, kinds_of<ReferenceTerm>(),
                               [&](TableReader& table, auto& term) { read_parameters(table, term, folder); });
}

}  // namespace wormdrive
