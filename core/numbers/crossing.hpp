#pragma once
#include <cstdint>
#include <optional>

#include <boost/math/tools/toms748_solve.hpp>

#include "core/numbers/series.hpp"

namespace wormdrive {

/// Root of f between a and b, where it has the values fa and fb of opposite sign or zero; the end behind the crossing.
template <class F>
double root_between(F&& f, double a, double fa, double b, double fb) {
  if (fa == 0.0) return a;
  if (fb == 0.0 || !(a < b)) return b;
  std::uintmax_t iterations = 200;
  return boost::math::tools::toms748_solve(f, a, b, fa, fb, boost::math::tools::eps_tolerance<double>(), iterations)
      .second;
}

/// Time in [a, b] at which a function of time falls through zero, also if it comes back within the step.
/// f(t) returns value and rate; left and right are f(a) and f(b); the function turns at most once in between.
template <class F>
std::optional<double> falling_crossing(F&& f, double a, const Series<double, 1>& left, double b,
                                       const Series<double, 1>& right) {
  const auto value = [&](double t) { return f(t)[0]; };
  if (right[0] < 0.0) {
    if (left[0] > 0.0) return root_between(value, a, left[0], b, right[0]);
    if (left[1] <= 0.0) return a;
    if (right[1] > 0.0) return std::nullopt;  // on its way up all along
    // begins at zero, to rounding, and rises: it falls behind its highest point
    const double highest = root_between([&](double t) { return f(t)[1]; }, a, left[1], b, right[1]);
    const double height = value(highest);
    return height > 0.0 ? root_between(value, highest, height, b, right[0]) : a;
  }
  if (left[1] >= 0.0 || right[1] <= 0.0) return std::nullopt;
  // falls at a, rises at b: the lowest point lies between
  const double lowest = root_between([&](double t) { return f(t)[1]; }, a, left[1], b, right[1]);
  const double depth = value(lowest);
  if (depth >= 0.0) return std::nullopt;
  return left[0] > 0.0 ? root_between(value, a, left[0], lowest, depth) : a;
}

}  // namespace wormdrive
