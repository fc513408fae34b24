#pragma once
#include "diagnosis/fitting/hypothesis.hpp"

namespace wormdrive {

/// Which bound a coordinate stands at: -1 its lower one, 1 its upper one, 0 none.
int bound_met(const Coordinate& c, double value);

/// Fits a candidate anew by its other laws and from within its bounds if it stands at one, and keeps what is better: a
/// fit that was led to a bound does not come back by itself.
void leave_bounds(const Evaluation& evaluation, Hypothesis& h, const Candidate& candidate);

}  // namespace wormdrive
