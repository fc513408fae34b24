#pragma once
#include <string>
#include <vector>

#include "recovery/campaign.hpp"

namespace recovery {

/// A class, or nothing, that a poor motion left, and what became of it when the experiment that was proposed was made.
struct Split {
  Case hidden;
  std::vector<std::string> members;  ///< of the class; empty: it was unexplained
  bool proposed = false;             ///< an experiment
  Score score = Score::crash;        ///< of the diagnosis of both recordings
  std::string answer{};
};

/// Hides effects of a plan in a slow motion. Where the answer is a class with the truth in it, or none, and an
/// experiment is proposed, the ground truth makes it, and both recordings are diagnosed together.
std::vector<Split> experiments(const Plan& plan, const Diagnose& diagnose);

/// A table in Markdown.
std::string table(const std::vector<Split>& splits);

}  // namespace recovery
