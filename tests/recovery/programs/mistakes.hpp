#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "recovery/campaign.hpp"

namespace recovery {

/// What somebody gets wrong in a data sheet or in a recording.
struct Mistake {
  std::string_view name;
  /// Makes it, of a size that is drawn; says which.
  std::string (*make)(wormdrive::Scenario& sheet, truth::Recording& recorded, truth::Generator& generator);
  std::vector<std::string_view> effects;   ///< causes that name it
  std::vector<std::string_view> words;     ///< of a sentence, a remark or a rejection; any of them tells of it
  bool may_be_harmless = false;            ///< an answer that the simulation has all that the data show is right, too
  std::vector<std::string_view> follow{};  ///< causes beside it that follow from it
};

/// In a data sheet; in a recording.
std::vector<Mistake> slips();
std::vector<Mistake> recording_faults();

struct Judged {
  std::string_view mistake;
  std::string size;
  Score score = Score::crash;
  std::string answer{};
};

/// Makes the mistakes in turn, on benches of a plan with nothing hidden, and judges what the diagnosis says of them.
std::vector<Judged> mistakes(const std::vector<Mistake>& all, const Plan& plan, const Diagnose& diagnose, int threads);

/// A table in Markdown.
std::string table(const std::vector<Judged>& judged);

}  // namespace recovery
