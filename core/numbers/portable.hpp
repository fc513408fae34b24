#pragma once
#include <cmath>
#include <limits>

#include "core/numbers/exponential.hpp"
#include "core/numbers/sine_cosine.hpp"

/// Elementary functions that take IEEE arithmetic alone, so that a run is the same bits on every machine. A C library
/// picks its variants by the processor, and they differ in the last bit.
namespace wormdrive::portable {

inline double sin(double x) { return sine_and_cosine(x).sine; }
inline double cos(double x) { return sine_and_cosine(x).cosine; }

/// ln x for a normal x > 0, wrong by less than two units in the last place.
inline double log(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);  // exact
  if (m < 0x1.6a09e667f3bcdp-1) {
    m *= 2.0;
    --exponent;
  }
  // ln m = 2 artanh(t), |t| < 0.172
  const double f = m - 1.0, t = f / (2.0 + f), z = t * t;
  double sum = 0.0;
#pragma GCC unroll 16
  for (int k = 23; k >= 3; k -= 2) sum = z * (sum + 1.0 / k);
  // 2 t = f - f t: f is exact, what is added to it is small
  const double rest = t * (f - 2.0 * sum);
  constexpr double ln2_high = 0x1.62e42fefa0000p-1, ln2_low = 0x1.cf79abc9e3b3ap-40;  // 38 bits and the rest
  return exponent * ln2_high + (f - (rest - exponent * ln2_low));
}

/// e^x, wrong by less than one unit in the last place; zero where it is less than 1e-307.
inline double exp(double x) {
  if (!(x < 709.0))
    return x > 709.0 ? std::numeric_limits<double>::infinity() : x == 709.0 ? 0x1.d422d2be5dc9bp+1022 : x;
  return x < 0.0 ? decay(-x) : exponential(x);
}

/// x^p for a normal x > 0.
inline double pow(double x, double p) { return exp(p * log(x)); }

}  // namespace wormdrive::portable
