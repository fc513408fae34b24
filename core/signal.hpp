#pragma once
#include <algorithm>
#include <limits>
#include <variant>
#include <vector>

#include "core/signals/constant.hpp"
#include "core/signals/ramp.hpp"
#include "core/signals/samples.hpp"
#include "core/signals/sinusoid.hpp"
#include "core/signals/staircase.hpp"
#include "core/signals/step.hpp"

namespace wormdrive {

/// Every kind of function of time; a new one is a new file and one entry here.
using SignalTerm = std::variant<Constant, Sinusoid, Ramp, Step, Staircase, Samples>;

/// A torque over time: the sum of its terms, smooth between knots.
struct Signal {
  std::vector<SignalTerm> terms;

  /// The smooth piece that is valid from t to the next knot.
  Piece piece(double t) const {
    Piece sum;
    sum.start = t;
    for (const SignalTerm& term : terms) std::visit([&](const auto& s) { s.add_to(sum, t); }, term);
    return sum;
  }

  /// The first time after t at which a term jumps or bends; infinity if there is none.
  double next_knot(double t) const {
    double next = std::numeric_limits<double>::infinity();
    for (const SignalTerm& term : terms)
      next = std::min(next, std::visit([&](const auto& s) { return s.next_knot(t); }, term));
    return next;
  }
};

}  // namespace wormdrive
