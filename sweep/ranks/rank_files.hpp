#pragma once
#include <string>
#include <vector>

#include "output/replacing.hpp"
#include "sweep/study/study.hpp"
#include "sweep/trial_range.hpp"

namespace wormdrive {

// Every rank writes the trials that it makes to a file of its own, NAME.rank_G_R.part with its rank R, where G counts
// how often the sweep was begun or resumed. When all trials are made they become NAME.

/// The name, without ".part", of a rank's file.
std::string rank_file(const std::string& name, std::uint64_t generation, int rank);

/// What ranks have left of a sweep: their files in the folder of NAME.
std::vector<std::string> rank_parts(const std::string& name);

/// What is there of a sweep before ranks go on with it.
struct RankPlan {
  bool complete = false;  ///< NAME itself holds every trial
  std::uint64_t generation = 0;
  std::uint64_t failed = 0;  ///< trials that are there but not done
  std::vector<TrialRange> missing;
};

/// Looks at what an interrupted sweep has left, by ranks or by a single process. Throws InputFault if that is of
/// another study or program, or if it is there and resume is not wanted, OutputFault if NAME may not be replaced.
RankPlan plan_ranks(const std::string& name, const Study& study, bool resume, Replace replace);

}  // namespace wormdrive
