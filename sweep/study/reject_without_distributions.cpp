#include "sweep/study/reject_without_distributions.hpp"

#include <fmt/format.h>

#include "description/diagnostics.hpp"

namespace wormdrive {

void reject_without_distributions(const Study& study, const std::string& path, std::string_view remedy) {
  if (std::holds_alternative<TableOfPoints>(study.design))
    reject({path}, fmt::format("comes from a table of points, which states no distributions to search; {}", remedy));
  if (const UncertainParameter* const drawn = study.drawn_by_rows())
    reject({path}, fmt::format("draws '{}' by rows of a file, between which there is nothing to search; {}",
                               drawn->path, remedy));
}

}  // namespace wormdrive
