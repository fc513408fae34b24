#pragma once
#include <optional>
#include <string>
#include <vector>

#include "diagnosis/diagnosis.hpp"
#include "diagnosis/inference/selection.hpp"
#include "diagnosis/verdict/learned_terms.hpp"

namespace wormdrive {

/// Where the names of all causes were withdrawn, the effect that alone, beside the base, predicts what it was not
/// fitted to better than they do, of those with the most evidence: it need not be one of them.
std::optional<Selection> better_alone(const Evaluation& evaluation, const Selection& selection,
                                      const std::vector<Candidate>& all);

/// Whether causes whose names were withdrawn stay in the extended scenario, as terms that claim none: if they predict
/// what they were not fitted to better than the drive does as stated, with other numbers within their tolerances, or
/// with a map of what is left.
bool unclaimed_terms_predict(const Diagnosis& diagnosis, const Evaluation& evaluation, const Selection& selection,
                             const std::vector<Candidate>& all, const std::optional<LearnedTerms>& learned);

/// Which terms these are and what they do, to be added to the sentence.
std::string unclaimed_terms_sentence(const Diagnosis& diagnosis, const Selection& selection,
                                     const std::vector<Candidate>& all);

}  // namespace wormdrive
