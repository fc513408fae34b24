#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "statistics/column.hpp"

namespace wormdrive {

/// Which rank a value has in a column, as its distance from the mean of the ranks; equal values share their mean rank.
/// Memory does not grow with the column: of more than 65536 values those share their rank that lie between two of an
/// evenly spaced sample of so many, which is of no consequence for a correlation.
class RankScale {
 public:
  /// column: of a known number of values.
  RankScale(const Column& column, std::uint64_t count);

  double operator()(double value) const { return deviations_[interval(value)]; }
  /// The sum of the squares over the column.
  double squares() const { return squares_; }

 private:
  std::size_t interval(double value) const;
  std::size_t cell(double value) const;
  void make_guide();

  static constexpr std::uint64_t most = 65536;
  std::vector<double> ends_;               ///< of the intervals whose values share a rank, the last one without
  double least_ = 0.0;                     ///< of the finite ends
  double cells_per_unit_ = 0.0;            ///< as many cells of equal width as there are ends
  std::vector<std::uint32_t> ends_below_;  ///< each cell: a guide to the ends
  std::vector<double> deviations_;         ///< of their ranks from the mean
  double squares_ = 0.0;
};

/// Rank correlation after Spearman of two columns hand in hand; 0 if one of them is constant.
double rank_correlation(const PairColumn& pairs, const RankScale& first, const RankScale& second);

}  // namespace wormdrive
