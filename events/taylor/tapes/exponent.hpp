#pragma once
#include <cstddef>
#include <span>

#include "core/numbers/lanes.hpp"
#include "events/taylor/polynomial_root.hpp"
#include "events/taylor/tapes/series.hpp"

namespace wormdrive {

/// How high the exponent of an exponential may get in a step, from what it is at its begin: of one that is tiny then,
/// the terms may be too small to be seen, whatever it becomes. Those of one that rises by e^4 add up to no more than
/// five times its largest visible term; below e^-40 it is less than the rounding of what it stands beside. One far
/// below that gets nearer by a factor of 2^10 at most: rounding of what it was then hides nothing of what it becomes.
template <class V>
V highest_exponent(const V& now) {
  return greatest<V>(now, least<V>(0x1p-10 * now, V(-40.0))) + 4.0;
}

/// When the first of the exponents in these places gets so high along its series to an order, within h [s]; h if none
/// does.
inline double end_of_rise(const TapeSeriesOf<double>& series, std::span<const int> exponents, int order, double h,
                          RootSearch& search) {
  for (const int place : exponents) {
    const double* const exponent = series[place];
    Coefficients left{};
    left[0] = highest_exponent(exponent[0]) - exponent[0];
    for (int k = 1; k <= order; ++k) left[static_cast<std::size_t>(k)] = -exponent[k];
    h = search.first_root({left.data(), static_cast<std::size_t>(order) + 1}, h).value_or(h);
  }
  return h;
}

}  // namespace wormdrive
