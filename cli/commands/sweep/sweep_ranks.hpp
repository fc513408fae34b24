#pragma once
#include <functional>
#include <string>

#include "cli/commands/sweep/sweep_steps.hpp"
#include "sweep/ranks/ranks.hpp"
#include "sweep/study/study.hpp"

namespace wormdrive {

/// Makes a sweep on several ranks, or goes on with one that ranks have left; returns the exit code.
int sweep_on_ranks(Ranks& ranks, const SweepOptions& options, const Study& study, const std::string& output);

/// The exit code of what the first rank does and tells, for all of them.
int code_of_all(Ranks& ranks, const std::function<int()>& command);

}  // namespace wormdrive
