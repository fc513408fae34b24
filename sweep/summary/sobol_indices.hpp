#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "statistics/column.hpp"
#include "sweep/study/design.hpp"
#include "sweep/summary/statistics.hpp"

namespace wormdrive {

/// What share of a metric's variance a parameter makes.
struct SobolIndex {
  SampleEstimate first, total;              ///< alone; with all it takes part in
  double first_deviation, total_deviation;  ///< standard errors
};

/// What share of a metric's variance two parameters make together, beyond what each makes alone.
struct PairIndex {
  std::size_t first, second;  ///< numbers of the parameters
  SampleEstimate index;
};

/// Sobol indices of every parameter, in their order.
struct SobolIndices {
  std::vector<SobolIndex> of;        ///< none if fewer than two samples are left or the metric is constant
  std::vector<PairIndex> pairs;      ///< none unless the design has them
  std::uint64_t used{}, left_out{};  ///< samples; those are left out of which a value is not finite
};

/// Sobol indices from a Saltelli design: values of one metric in the order of its trials, from the first one on.
/// Estimators of Saltelli 2010 for the first, Jansen 1999 for the total and Saltelli 2002 for a pair's index. Intervals
/// are those of Student's t from the jackknife over the design's replicates [Owen1997]: draws within one are not
/// independent, replicates are.
SobolIndices sobol_indices(const Column& values, const Saltelli& design, std::size_t parameters);

}  // namespace wormdrive
