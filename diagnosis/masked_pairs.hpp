#pragma once
#include <vector>

#include "diagnosis/screening.hpp"

namespace wormdrive {

/// Two suspects that may hide each other: what one does the other takes back in part.
struct MaskedPair {
  std::size_t first, second;  ///< suspects
  std::size_t first_start, second_start;
  double gain;  ///< of the BIC, in the linear fit
};

/// The pairs that promise more than a gain of the BIC, by one linear fit of all signatures; the best first.
std::vector<MaskedPair> masked_pairs(const Evaluation& by, const Hypothesis& base, const Screening& screening,
                                     const std::vector<Suspect>& all, double more_than, std::size_t most);

}  // namespace wormdrive
