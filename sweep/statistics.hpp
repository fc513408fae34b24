#pragma once
#include <cstdint>
#include <vector>

namespace wormdrive {

/// An estimate and where the truth lies with 95 % confidence.
struct Estimate {
  double value, low, high;
};

/// The p-quantile of a sample in rising order, with the exact interval of independent draws, which needs no assumption
/// about their distribution [Hahn1991]; an end is infinite where the sample is too small for it.
Estimate sample_quantile(const std::vector<double>& rising, double p);

/// Probability of what happened k times in n independent trials, with the exact binomial interval [ClopperPearson1934].
Estimate probability(std::uint64_t k, std::uint64_t n);

/// Rank correlation after Spearman between two equally long columns, equal values sharing their mean rank; 0 if one of
/// them is constant.
class Ranks {
 public:
  explicit Ranks(const std::vector<double>& values);
  double correlation(const Ranks& other) const;

 private:
  std::vector<double> deviations_;  ///< of the ranks from their mean
  double squares_ = 0.0;
};

/// What share of a metric's variance a parameter makes.
struct SobolIndex {
  Estimate first, total;                    ///< alone; with all it takes part in
  double first_deviation, total_deviation;  ///< standard errors
};

/// Sobol indices of every parameter from a Saltelli design: values of one metric in the order of its trials, blocks of
/// parameters + 2; blocks with a value that is not finite are left out. Estimators of Saltelli 2010 for the first and
/// Jansen 1999 for the total index, intervals from resampled blocks. Empty if fewer than two blocks are left or the
/// metric is constant.
std::vector<SobolIndex> sobol_indices(const std::vector<double>& values, std::size_t parameters, std::uint64_t seed);

}  // namespace wormdrive
