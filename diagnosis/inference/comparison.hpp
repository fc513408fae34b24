#pragma once
#include <algorithm>

#include "diagnosis/fitting/hypothesis.hpp"

namespace wormdrive {

/// From when on a candidate is believed.
struct AcceptanceRules {
  double least_bic = 20.0;            ///< gain of the BIC by a candidate of which nothing is stated
  double least_held_out = 3.0;        ///< gain of held-out data [nats]
  double clip = 4.0;                  ///< medians at which a block's gain is cut
  double positive_share = 0.7;        ///< of the blocks, if the gain counts clipped only
  double least_bic_toleranced = 5.0;  ///< gain of the BIC by a stated number that is off
  double least_tolerances = 3.5;      ///< from the stated value, for such a number
  double loss_share = 0.05;           ///< of the BIC's gain that held-out data may lose by such a number [nats]
};

/// How a model with a candidate compares with one without it.
struct Evidence {
  double delta_bic{};
  double held_out{};             ///< gain of held-out data [nats]
  double without_best{};         ///< the same without the block that gains most
  double clipped{};              ///< the same with every block's gain clipped
  double positive_share{};       ///< of the held-out blocks that gain
  double tolerances{};           ///< largest distance of a stated number from its value, in tolerances
  double everywhere_but_best{};  ///< gain of all data, fitted or not, without the block that gains most [nats]
  bool beside_gap = false;       ///< a gap between the teeth is in both models
  bool at_bound = false;         ///< a coordinate of the candidate came to rest at its bound
};

Evidence compare(const Hypothesis& without, const Hypothesis& with, const Candidate& candidate,
                 const InnovationLayout& layout);

/// Whether a stated effect turns out to be none.
bool is_removed(const Hypothesis& h, const Candidate& candidate);

bool accepted(const Evidence& evidence, const Candidate& candidate, const AcceptanceRules& rules = {});

/// Candidates whose evidence is within reach of the best one's form a class with it.
inline constexpr double equivalence_share = 0.03;
inline double equivalence_margin(double best) { return std::max(10.0, equivalence_share * best); }

/// Whether a candidate as it was fitted is hard to tell from another one by its nature, whatever the evidence: a fall
/// of friction over little more than the smallest speed that it may have is nearly friction at rest.
bool indistinguishable_from(const Hypothesis& h, const Candidate& candidate, const Candidate& other);

/// Why a candidate is not believed; "named" if it is.
std::string outcome(const Evidence& evidence, const Candidate& candidate, const AcceptanceRules& rules = {});

}  // namespace wormdrive
