#pragma once
#include <vector>

#include "diagnosis/fitting/hypothesis.hpp"

namespace wormdrive {

/// What a candidate promises beside a hypothesis: one joint step of the linear fit, checked by one true prediction.
struct Screened {
  std::size_t candidate, start;
  double gain = -std::numeric_limits<double>::infinity();  ///< of the BIC
  Hypothesis model{};                                      ///< after the step; its innovations are not kept
  /// Changes of the whitened innovations, per scale or by the start; none of what is free already or of a far value. In
  /// single precision: of long recordings they take most of the memory.
  std::vector<std::vector<float>> signatures{};
  bool is_far = false;  ///< a far value, of which no slope is known
};

/// What screening knows of the hypothesis itself.
struct Screening {
  std::vector<std::vector<double>> free_columns{};  ///< of the free coordinates
  std::vector<Screened> found{};                    ///< the best first
};

/// Screens all candidates but those that a hypothesis has already.
Screening screen(const Evaluation& evaluation, const Hypothesis& h, const std::vector<Candidate>& all);

/// Whether a candidate would change nothing: it is a cause already, or all it has is free without a tolerance.
bool is_in(const Hypothesis& h, const std::vector<Candidate>& all, std::size_t candidate);

}  // namespace wormdrive
