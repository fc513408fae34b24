#pragma once
// What tests of numbers share, without the drives of support.hpp.
#include <cmath>
#include <iomanip>
#include <ostream>

namespace wormdrive::test {

/// The largest of many deviations. Unlike std::max it does not lose a NaN, and a failed test prints it in full.
struct Deviation {
  double size = 0.0;

  void add(double deviation) {
    if (!(std::abs(deviation) <= size)) size = std::abs(deviation);
  }
  friend bool operator<=(const Deviation& worst, double tolerance) { return worst.size <= tolerance; }
  friend std::ostream& operator<<(std::ostream& out, const Deviation& worst) {
    return out << std::scientific << std::setprecision(3) << worst.size;
  }
};

/// Whether a value is the expected one within a share of it.
inline bool close(double value, double expected, double share) {
  return std::abs(value - expected) <= share * std::abs(expected);
}

/// Where, between two numbers, something ends that holds at the low one and not at the high one: the first number at
/// which it does not hold, by bisection.
template <class Holds>
double end_of(double low, double high, Holds&& holds) {
  for (;;) {
    const double middle = low + 0.5 * (high - low);
    if (middle <= low || middle >= high) return high;
    (holds(middle) ? low : high) = middle;
  }
}

}  // namespace wormdrive::test
