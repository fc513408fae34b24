#include "core/numbers/decay.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "catch.hpp"
#include "numbers.hpp"

// What decays, and its repeated integrals.

namespace wormdrive::test::core_decay {

namespace {

/// The k-th repeated integral of e^-s from 0 to x, divided by x^k: the integral of (1 - u)^(k-1)/(k-1)! e^(-x u) from 0
/// to 1, by Gauss's five points in each of many parts of where it is not nothing.
double by_quadrature(int k, double x) {
  constexpr std::array<long double, 5> points{-0.906179845938663992797627L, -0.538469310105683091036314L, 0.0L,
                                              0.538469310105683091036314L, 0.906179845938663992797627L};
  constexpr std::array<long double, 5> weights{0.236926885056189087514264L, 0.478628670499366468041292L,
                                               0.568888888888888888888889L, 0.478628670499366468041292L,
                                               0.236926885056189087514264L};
  constexpr int parts = 1000;
  const long double end = std::min(1.0L, 60.0L / x), half = end / (2 * parts);
  long double sum = 0.0L, factorial = 1.0L;
  for (int n = 2; n < k; ++n) factorial *= n;
  for (int part = 0; part < parts; ++part)
    for (std::size_t n = 0; n < points.size(); ++n) {
      const long double u = half * (2 * part + 1 + points[n]);
      sum += weights[n] * std::pow(1.0L - u, static_cast<long double>(k - 1)) * std::exp(-x * u);
    }
  return static_cast<double>(sum * half / factorial);
}

}  // namespace

TEST_CASE("repeated integrals of a decay are exact to rounding from a millionth of its time constant to 600 of them") {
  Deviation worst;
  for (double x = 1e-6; x < 600.0; x *= 1.37) {
    const DecayOf<double> decay(x);
    INFO("x = " << x);
    REQUIRE(close(decay.left(), std::exp(-x), 4e-16));
    for (int k = 1; k <= DecayOf<double>::last; ++k) {
      const double expected = by_quadrature(k, x);
      worst.add(decay.integrals[k] / expected - 1.0);
      REQUIRE(close(decay.integrals[k], expected, k <= 2 ? 1e-15 : 2e-14));
    }
  }
  REQUIRE(worst.size > 0.0);
}

TEST_CASE("a decay that has not begun has left all, and one that is over nothing") {
  const DecayOf<double> none(0.0), all(1e300);
  REQUIRE(none.left() == 1.0);
  REQUIRE(none.integrals[3] == 1.0 / 6);
  REQUIRE(all.left() == 0.0);
  REQUIRE(all.integrals[1] == 1e-300);
}

TEST_CASE("coefficients of a decay are those of its exponential") {
  std::array<double, 9> c{};
  expand_decay(3.0, 0.5, 8, c.data());
  double sum = 3.0, power = 1.0;
  for (int k = 1; k <= 8; ++k) sum += c[static_cast<std::size_t>(k)] * (power *= 0.05);
  REQUIRE(close(sum, 3.0 * std::exp(-0.1), 1e-14));
}

}  // namespace wormdrive::test::core_decay
