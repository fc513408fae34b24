// Statistics against published and exact values.
#include "sweep/statistics.hpp"

#include <algorithm>
#include <limits>
#include <numbers>
#include <numeric>

#include "catch.hpp"
#include "numbers.hpp"
#include "sweep/design.hpp"
#include "sweep/random.hpp"

using namespace wormdrive;
using test::close;

namespace {

template <class Function>
std::vector<double> evaluated(Function&& f, std::size_t parameters, std::uint64_t samples) {
  Design design(Saltelli{samples}, parameters, 4);
  std::vector<double> values;
  for (std::uint64_t k = 0; k < samples * (parameters + 2); ++k) values.push_back(f(design.point(k)));
  return values;
}

/// Indices within three standard errors of the exact ones, and these errors not so large that all is true.
void check_indices(const std::vector<SobolIndex>& found, const std::vector<double>& first,
                   const std::vector<double>& total) {
  REQUIRE(found.size() == first.size());
  for (std::size_t k = 0; k < found.size(); ++k) {
    INFO("parameter " << k << ": first " << found[k].first.value << " +- " << found[k].first_deviation << ", total "
                      << found[k].total.value << " +- " << found[k].total_deviation);
    CHECK(std::abs(found[k].first.value - first[k]) <= 3.0 * found[k].first_deviation);
    CHECK(std::abs(found[k].total.value - total[k]) <= 3.0 * found[k].total_deviation + 1e-12);
    CHECK(found[k].first_deviation < 0.03);
    CHECK(found[k].total_deviation < 0.03);
    CHECK(found[k].first.low <= found[k].first.value);
    CHECK(found[k].first.high >= found[k].first.value);
  }
}

}  // namespace

TEST_CASE("Sobol indices of the Ishigami function", "[sweep]") {
  constexpr double pi = std::numbers::pi, a = 7.0, b = 0.1;
  const auto ishigami = [&](const std::vector<double>& u) {
    const double x = pi * (2.0 * u[0] - 1.0), y = pi * (2.0 * u[1] - 1.0), z = pi * (2.0 * u[2] - 1.0);
    return std::sin(x) + a * std::sin(y) * std::sin(y) + b * z * z * z * z * std::sin(x);
  };
  const double pi4 = std::pow(pi, 4), variance = a * a / 8 + b * pi4 / 5 + b * b * pi4 * pi4 / 18 + 0.5;
  const double Vx = 0.5 * std::pow(1 + b * pi4 / 5, 2), Vy = a * a / 8, Vxz = b * b * pi4 * pi4 * 8 / 225;
  check_indices(sobol_indices(evaluated(ishigami, 3, 8192), 3, 1), {Vx / variance, Vy / variance, 0.0},
                {(Vx + Vxz) / variance, Vy / variance, Vxz / variance});
}

TEST_CASE("Sobol indices of a linear model, far from zero", "[sweep]") {
  const auto linear = [](const std::vector<double>& u) { return 1e6 + 3.0 * u[0] + 2.0 * u[1] + u[2] + 0.0 * u[3]; };
  const std::vector<double> exact{9.0 / 14, 4.0 / 14, 1.0 / 14, 0.0};
  check_indices(sobol_indices(evaluated(linear, 4, 4096), 4, 1), exact, exact);
}

TEST_CASE("blocks of a Saltelli design with a failed trial are left out", "[sweep]") {
  const auto linear = [](const std::vector<double>& u) { return 3.0 * u[0] + 2.0 * u[1]; };
  std::vector<double> values = evaluated(linear, 2, 4096);
  for (std::size_t k = 0; k < values.size(); k += 37) values[k] = std::numeric_limits<double>::quiet_NaN();
  check_indices(sobol_indices(values, 2, 1), {9.0 / 13, 4.0 / 13}, {9.0 / 13, 4.0 / 13});
  CHECK(sobol_indices(std::vector<double>(40, 1.0), 2, 1).empty());
}

TEST_CASE("Clopper and Pearson's intervals", "[sweep]") {
  // k = 0: 1 - (alpha/2)^(1/n)
  CHECK(probability(0, 100).low == 0.0);
  CHECK(close(probability(0, 100).high, 1.0 - std::pow(0.025, 0.01), 1e-12));
  CHECK(close(probability(100, 100).low, std::pow(0.025, 0.01), 1e-12));
  // R: binom.test(5, 100)$conf.int
  CHECK(close(probability(5, 100).low, 0.01643189, 1e-6));
  CHECK(close(probability(5, 100).high, 0.11283492, 1e-6));
}

TEST_CASE("a quantile's interval holds the truth as often as it says", "[sweep]") {
  constexpr int experiments = 2000, n = 200;
  for (const double p : {0.05, 0.5, 0.95}) {
    int caught = 0;
    for (std::uint64_t e = 0; e < experiments; ++e) {
      std::vector<double> values;
      for (std::uint64_t k = 0; k < n; ++k)
        values.push_back(to_unit_interval(random_bits(e, SweepStream::draws, k, 0)[0]));
      std::sort(values.begin(), values.end());
      const Estimate found = sample_quantile(values, p);
      if (found.low <= p && p <= found.high) ++caught;
    }
    CHECK(caught >= 0.94 * experiments);   // conservative, so at least 95 % up to the noise of 2000
    CHECK(caught <= 0.985 * experiments);  // but no wider than it need be
  }
  std::vector<double> rising(101);
  std::iota(rising.begin(), rising.end(), 0.0);
  CHECK(sample_quantile(rising, 0.5).value == 50.0);
  CHECK(close(sample_quantile(rising, 0.955).value, 95.5, 1e-12));
  CHECK(std::isinf(sample_quantile({1.0, 2.0, 3.0}, 0.99).high));
}

TEST_CASE("rank correlation sees order alone, and shares ranks among equals", "[sweep]") {
  const Ranks rising({1.0, 2.0, 3.0, 4.0}), curved({1.0, 8.0, 27.0, 64.0}), falling({4.0, 3.0, 2.0, 1.0});
  CHECK(close(rising.correlation(curved), 1.0, 1e-15));
  CHECK(close(rising.correlation(falling), -1.0, 1e-15));
  CHECK(rising.correlation(Ranks({5.0, 5.0, 5.0, 5.0})) == 0.0);
  // ranks 1 2.5 2.5 4 against 1 2 3 4: 4.5 / sqrt(4.5 * 5)
  CHECK(close(rising.correlation(Ranks({1.0, 2.0, 2.0, 7.0})), 4.5 / std::sqrt(22.5), 1e-15));
}
