#pragma once
#include <string>

#include "near_ties/case.hpp"

namespace wormdrive::test::near_ties {

enum class Verdict {
  agree,       ///< one list of events, which nothing contradicts
  rounding,    ///< lists differ, and each is right for torques that differ by roundings
  halt,        ///< a solver says that it cannot go on, and why
  not_judged,  ///< lists agree; the judge would have taken too long
  undecided,   ///< lists differ; the judge would have taken too long
  silent,      ///< a solver went on in a mode that its state contradicts, or lists differ without a reason
};
inline constexpr const char* names[] = {
    "agree", "differ by rounding", "halt", "agree, not judged", "differ, not judged", "silent difference"};

struct Judgement {
  Verdict verdict;
  std::string reason{};  ///< of a halt, and of a difference that is a fault or undecided
};

/// Runs a case by every solver that takes it; judged, or where lists differ, by the judge as well.
Judgement judgement(const Case& tie, bool judged);

/// A case in words and numbers, several lines.
std::string describe(const Case& tie);
std::string describe(const ProgramRun& run);

}  // namespace wormdrive::test::near_ties
