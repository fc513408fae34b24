#pragma once
#include <string_view>
#include <vector>

#include "diagnosis/candidates/catalogue.hpp"

namespace wormdrive {

/// Parts of a drive that only a scenario knows of, as a motor with a winding, a coupling or a brake: what it states of
/// one may be another number. One candidate each, of those that are on.
std::vector<Candidate> stated_parts(const Effects<double>& stated);

/// Those that are no candidates, for the scenario does not state them or no number of theirs shows, with the reason.
std::vector<NotExamined> parts_not_examined(const Effects<double>& stated);

}  // namespace wormdrive
