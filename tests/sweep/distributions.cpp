// Draws and distributions against closed forms and against a library.
#include <boost/math/distributions/normal.hpp>

#include "catch.hpp"
#include "numbers.hpp"
#include "statistics/normal.hpp"
#include "sweep/study/correlation.hpp"
#include "sweep/study/distribution.hpp"
#include "sweep/study/random.hpp"

namespace wormdrive::test::sweep_distributions {

namespace {

/// Mean and standard deviation by the midpoint rule over the probability.
struct Moments {
  double mean = 0.0, deviation = 0.0;

  explicit Moments(const Distribution& distribution, int n = 200000) {
    double squares = 0.0;
    for (int k = 0; k < n; ++k) {
      const double x = quantile(distribution, (k + 0.5) / n);
      mean += x / n;
      squares += x * x / n;
    }
    deviation = std::sqrt(squares - mean * mean);
  }
};

}  // namespace

TEST_CASE("the program's log and exp equal those of the C library", "[sweep]") {
  Deviation log_error, exp_error;
  for (int k = 1; k < 20000; ++k) {
    const double u = to_unit_interval(random_bits(1, SweepStream::draws, k, 0)[0]);
    for (const double x : {u, u * u * u * u * 1e-300, 1.0 + 1e-6 * (u - 0.5), 1e5 * u}) {
      const double exact = std::log(x);
      log_error.add(exact == 0.0 ? portable::log(x) : (portable::log(x) - exact) / exact);
    }
    for (const double x : {u - 0.5, 1400.0 * (u - 0.5), 1e-9 * u}) exp_error.add(portable::exp(x) / std::exp(x) - 1.0);
  }
  CHECK(log_error <= 4.5e-16);
  CHECK(exp_error <= 4.5e-16);
}

TEST_CASE("the normal quantile and its inverse equal those of boost.math", "[sweep]") {
  const boost::math::normal_distribution<double> normal;
  Deviation forth, back;
  for (const double u : {1e-300, 1e-20, 1e-9, 1e-3, 0.02, 0.074, 0.076, 0.2, 0.4999, 0.7, 0.926, 0.99, 1.0 - 1e-12}) {
    const double z = quantile(normal, u);
    forth.add(normal_quantile(u) / z - 1.0);
    if (u < 0.5) back.add(normal_probability(z) / u - 1.0);
    if (u > 0.5) back.add((1.0 - normal_probability(z)) / (1.0 - u) - 1.0);
  }
  CHECK(forth <= 2e-15);
  CHECK(back <= 1e-4);  // of 1 - u = 1e-12 a double near 1 has four digits
  CHECK(normal_quantile(0.5) == 0.0);
}

TEST_CASE("distributions have the moments of their closed forms", "[sweep]") {
  const Moments uniform(Uniform{-1.0, 3.0});
  CHECK(close(uniform.mean, 1.0, 1e-9));
  CHECK(close(uniform.deviation, 4.0 / std::sqrt(12.0), 1e-8));
  const Moments normal(Normal{2.0, 0.5});
  CHECK(close(normal.mean, 2.0, 1e-9));
  CHECK(close(normal.deviation, 0.5, 1e-4));
  const Moments lognormal(Lognormal{0.25, 0.3});
  CHECK(close(lognormal.mean, 0.25 * std::exp(0.045), 1e-5));
  CHECK(close(lognormal.deviation, 0.25 * std::exp(0.045) * std::sqrt(std::exp(0.09) - 1.0), 1e-3));
  const Moments triangular(Triangular{1.0, 2.0, 6.0});
  CHECK(close(triangular.mean, 3.0, 1e-6));
  CHECK(close(triangular.deviation, std::sqrt((1.0 + 4.0 + 36.0 - 2.0 - 6.0 - 12.0) / 18.0), 1e-6));
  const Moments discrete(Discrete{{1.0, 2.0, 4.0}, {1.0, 2.0, 1.0}});
  CHECK(close(discrete.mean, 2.25, 1e-6));
  const Moments table(QuantileTable{{0.0, 1.0, 5.0}, {0.0, 0.5, 1.0}});
  CHECK(close(table.mean, 1.75, 1e-6));
}

TEST_CASE("a truncated normal distribution follows the closed form, also far out in its tails", "[sweep][slow]") {
  const boost::math::normal_distribution<double> unit;
  const auto [low, high] = std::pair{-0.5, 2.0};
  const Moments cut(TruncatedNormal{0.0, 1.0, low, high});
  const double mass = cdf(unit, high) - cdf(unit, low);
  CHECK(close(cut.mean, (pdf(unit, low) - pdf(unit, high)) / mass, 1e-6));
  for (const double sign : {-1.0, 1.0}) {
    // beyond 8 deviations the tail is nearly exponential, and 1 - probability has lost all its digits
    TruncatedNormal far{0.0, 1.0};
    (sign > 0.0 ? far.low : far.high) = sign * 8.0;
    const double middle = quantile(complement(unit, 0.5 * cdf(complement(unit, 8.0))));
    CHECK(close(far.quantile(0.5), sign * middle, 1e-12));
    CHECK(sign * far.quantile(1e-12) >= 8.0);
    CHECK(sign * far.quantile(1.0 - 1e-12) >= 8.0);
  }
}

TEST_CASE("quantiles follow their definitions", "[sweep]") {
  CHECK(Uniform{-1.0, 3.0}.quantile(0.25) == 0.0);
  CHECK(Lognormal{0.25, 0.3}.quantile(0.5) == 0.25);
  CHECK(Triangular{1.0, 2.0, 6.0}.quantile(0.2) == 2.0);
  CHECK(Triangular{0.0, 0.0, 1.0}.quantile(0.75) == 0.5);
  const Discrete weighted{{10.0, 20.0, 30.0}, {1.0, 0.0, 3.0}};
  CHECK(weighted.quantile(0.24) == 10.0);
  CHECK(weighted.quantile(0.26) == 30.0);
  CHECK(weighted.quantile(1.0 - 1e-16) == 30.0);
  CHECK(QuantileTable{{0.0, 1.0, 5.0}, {0.0, 0.5, 1.0}}.quantile(0.75) == 3.0);
}

TEST_CASE("a copula gives the stated correlation and keeps every distribution", "[sweep]") {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(3, 3);
  matrix(0, 2) = matrix(2, 0) = 0.8;
  const Copula copula(matrix);
  constexpr int n = 100000;
  double product = 0.0, other = 0.0;
  std::vector<int> counts(10);
  for (int k = 0; k < n; ++k) {
    std::vector<double> u;
    for (std::uint64_t p = 0; p < 3; ++p) u.push_back(to_unit_interval(random_bits(7, SweepStream::draws, k, p)[0]));
    const std::vector<double> before = u;
    copula.apply(u);
    REQUIRE(u[0] == before[0]);
    REQUIRE(u[1] == before[1]);
    product += normal_quantile(u[0]) * normal_quantile(u[2]) / n;
    other += normal_quantile(u[1]) * normal_quantile(u[2]) / n;
    ++counts[static_cast<std::size_t>(u[2] * 10.0)];
  }
  CHECK(std::abs(product - 0.8) < 4.0 * std::sqrt((1.0 + 0.64) / n));
  CHECK(std::abs(other) < 4.0 / std::sqrt(n));
  for (const int count : counts) CHECK(std::abs(count - n / 10) < 4.0 * std::sqrt(0.09 * n));
  matrix(0, 1) = matrix(1, 0) = 0.8;
  matrix(1, 2) = matrix(2, 1) = -0.8;
  CHECK_FALSE(Copula::exists(matrix));
}

}  // namespace wormdrive::test::sweep_distributions
