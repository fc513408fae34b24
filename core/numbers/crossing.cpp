#include "core/numbers/crossing.hpp"

#include <cstdint>

#include <boost/math/tools/toms748_solve.hpp>

namespace wormdrive {

double root_between(const FunctionView<double>& f, double a, double fa, double b, double fb) {
  if (fa == 0.0) return a;
  if (fb == 0.0 || !(a < b)) return b;
  std::uintmax_t iterations = 200;
  return boost::math::tools::toms748_solve(f, a, b, fa, fb, boost::math::tools::eps_tolerance<double>(), iterations)
      .second;
}

std::optional<double> search_fall(const FunctionView<Series<double, 1>>& f, double a, const Series<double, 1>& left,
                                  double b, const Series<double, 1>& right) {
  const auto at = [&f](double t) { return f(t)[0]; };
  const auto slope = [&f](double t) { return f(t)[1]; };
  const FunctionView<double> value(at), rate(slope);
  if (right[0] < 0.0) {
    if (left[0] > 0.0) return root_between(value, a, left[0], b, right[0]);
    if (left[1] <= 0.0) return a;
    if (right[1] > 0.0) return std::nullopt;  // on its way up all along
    // begins at zero, to rounding, and rises: it falls behind its highest point
    const double highest = root_between(rate, a, left[1], b, right[1]);
    const double height = value(highest);
    return height > 0.0 ? root_between(value, highest, height, b, right[0]) : a;
  }
  // falls at a, rises at b: the lowest point lies between
  const double lowest = root_between(rate, a, left[1], b, right[1]);
  const double depth = value(lowest);
  if (depth >= 0.0) return std::nullopt;
  return left[0] > 0.0 ? root_between(value, a, left[0], lowest, depth) : a;
}

}  // namespace wormdrive
