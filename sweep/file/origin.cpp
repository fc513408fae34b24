#include "sweep/file/origin.hpp"

#include <fmt/format.h>

#include "description/toml/write_scenario.hpp"
#include "output/program.hpp"
#include "sweep/study/load_study.hpp"

namespace wormdrive {

Origin origin_of(const Study& study) { return {study.text, to_toml(study.scenario), program_identity()}; }

std::string why_not_beside(const Origin& there, const Origin& here, std::string_view whose_build) {
  if (const auto other = difference(there.study, here.study)) return "the study differs in " + *other;
  if (const auto other = difference(there.scenario, here.scenario)) return "the scenario differs in " + *other;
  return there.build == here.build ? ""
                                   : fmt::format("it was made by {}, but {} {}", there.build, whose_build, here.build);
}

}  // namespace wormdrive
