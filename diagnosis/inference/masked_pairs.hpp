#pragma once
#include <vector>

#include "diagnosis/fitting/linear_system.hpp"

namespace wormdrive {

/// Two candidates that may hide each other: what one does the other takes back in part.
struct MaskedPair {
  std::size_t first, second;  ///< candidates
  std::size_t first_start, second_start;
  double gain;  ///< of the BIC, in the linear fit
};

/// By how much a pair has to gain more than causes that gain so much themselves [BIC].
double clear_margin(double gain);

/// The pairs that promise clearly more than these causes, or about as much as three or more, by one linear fit of all
/// signatures for both, which knows nothing of how the noise changes with a better model; the best first.
std::vector<MaskedPair> masked_pairs(const LinearSystem& linear, const Hypothesis& base,
                                     const std::vector<Candidate>& all, const std::vector<std::size_t>& causes,
                                     std::size_t most);

}  // namespace wormdrive
