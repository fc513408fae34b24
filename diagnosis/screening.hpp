#pragma once
#include <vector>

#include "diagnosis/hypothesis.hpp"

namespace wormdrive {

/// What a suspect promises beside a hypothesis: one joint step of the linear fit, checked by one true prediction.
struct Screened {
  std::size_t suspect, start;
  double gain = -std::numeric_limits<double>::infinity();  ///< of the BIC
  Hypothesis model{};                                      ///< after the step
  std::vector<std::vector<double>> signatures{};  ///< changes of the whitened innovations, per scale or by the start
};

/// What screening knows of the hypothesis itself.
struct Screening {
  std::vector<std::vector<double>> free_columns{};  ///< of the free coordinates
  std::vector<Screened> found{};                    ///< the best first
};

/// Screens all suspects but those that a hypothesis has already.
Screening screen(const Evaluation& by, const Hypothesis& h, const std::vector<Suspect>& all);

/// Whether a suspect would change nothing: it is a cause already, or all it has is free without a tolerance.
bool is_in(const Hypothesis& h, const std::vector<Suspect>& all, std::size_t suspect);

}  // namespace wormdrive
