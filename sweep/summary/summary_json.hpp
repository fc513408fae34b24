#pragma once
#include <nlohmann/json_fwd.hpp>

#include "sweep/summary/summary.hpp"

namespace wormdrive {

/// What `wormdrive summary --json` prints and wormdrive.summary() of Python returns. running: whether the sweep is
/// still being made.
nlohmann::json summary_json(const SweepReader& sweep, const SweepSummary& summary, bool running);

}  // namespace wormdrive
