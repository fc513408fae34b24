#pragma once
#include "diagnosis/fitting/hypothesis.hpp"

namespace wormdrive {

/// Whether the likelihood has a slope over a coordinate. Over friction at rest it has steps: a model breaks away at
/// another sample, or it does not.
bool has_slope(const Coordinate& coordinate);

/// Moves the free coordinates without a slope to where they fit best, by ever smaller shares of their values. Of an
/// evaluated hypothesis; true if it got better.
bool search_steps(const Evaluation& evaluation, Hypothesis& h);

/// Standard error of a free coordinate without a slope: half of what the likelihood leaves open. It is at least the
/// coordinate's scale, because noise moves a break-away.
double spread_of_steps(const Evaluation& evaluation, const Hypothesis& h, std::size_t coordinate);

}  // namespace wormdrive
