#pragma once
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "sweep/study/correlation.hpp"

namespace wormdrive {

/// Which stratum of each parameter a trial of a Latin hypercube uses where parameters are correlated [ImanConover1982]:
/// the strata of a parameter are dealt out in the order of correlated normal scores, so that each is still used once.
/// That takes the whole design, which is laid out when the first trial is asked for; threads may share it.
class CorrelatedStrata {
 public:
  /// Trials that are laid out at most; each takes four bytes for every correlated parameter.
  static constexpr std::uint64_t most_trials = 10'000'000;

  CorrelatedStrata(std::uint64_t trials, Copula copula, std::uint64_t seed)
      : trials_(trials), copula_(std::move(copula)), seed_(seed) {}

  std::uint64_t operator()(std::uint64_t trial, std::size_t parameter) const;

 private:
  void lay_out() const;

  std::uint64_t trials_;
  Copula copula_;
  std::uint64_t seed_;
  mutable std::once_flag laid_out_;
  mutable std::vector<std::vector<std::uint32_t>> strata_;  ///< of each parameter and trial; none of a free parameter
};

}  // namespace wormdrive
