#pragma once
#include <algorithm>

#include "diagnosis/fitting/hypothesis.hpp"
#include "diagnosis/rules/evidence.hpp"

namespace wormdrive {

/// How a model with a candidate compares with one without it.
struct Evidence {
  double delta_bic{};
  double of_tolerances{};        ///< what of it stated parameters give that move back towards their values
  double held_out{};             ///< gain of held-out data [nats]
  double without_best{};         ///< the same without the block that gains most
  double clipped{};              ///< the same with every block's gain clipped
  double positive_share{};       ///< of the ranks by size of the held-out blocks, those that gain [Wilcoxon 1945]
  double tolerances{};           ///< largest distance of a stated parameter from its value, in tolerances
  double tolerances_without{};   ///< the same while its tolerance draws it back
  double everywhere_but_best{};  ///< gain of all data, fitted or not, without the block that gains most [nats]
  double lower_error{};          ///< share of the error ahead that goes, if this is to decide
  bool beside_gap = false;       ///< a gap between the teeth is in both models
  bool at_bound = false;         ///< a coordinate of the candidate came to rest at its bound
  bool at_limit = false;         ///< the only such one makes it its limiting case there
};

Evidence compare(const Hypothesis& without, const Hypothesis& with, const Candidate& candidate,
                 const InnovationLayout& layout);

/// Whether a stated effect turns out to be none.
bool is_removed(const Hypothesis& h, const Candidate& candidate);

bool accepted(const Evidence& evidence, const Candidate& candidate);

/// Whether nothing but the likelihood of what was held out speaks against a candidate.
bool refuted(const Evidence& evidence, const Candidate& candidate);

/// Candidates whose evidence is within reach of the best one's form a class with it.
inline double equivalence_margin(double best) {
  return std::max(rules::equivalence_bic, rules::equivalence_share * best);
}

/// Whether a candidate as it was fitted is hard to tell from another one by its nature, whatever the evidence: a fall
/// of friction over little more than the smallest speed that it may have is nearly friction at rest.
bool indistinguishable_from(const Hypothesis& h, const Candidate& candidate, const Candidate& other);

/// Why a candidate is not believed; "named" if it is.
std::string outcome(const Evidence& evidence, const Candidate& candidate);

}  // namespace wormdrive
