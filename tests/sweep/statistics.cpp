// Statistics against published and exact values.
#include "sweep/summary/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>

#include "catch.hpp"
#include "numbers.hpp"
#include "statistics/order_statistics.hpp"
#include "statistics/rank_correlation.hpp"
#include "sweep/study/design.hpp"
#include "sweep/study/random.hpp"
#include "sweep/summary/sobol_indices.hpp"

namespace wormdrive::test::sweep_statistics {

namespace {

/// Values as a column that is handed over in parts, no two of them equally long.
Column column(std::vector<double> values) {
  return [values = std::move(values)](const TakeValues& take) {
    std::span<const double> left(values);
    for (std::size_t part = 1; !left.empty(); part += 2) {
      take(left.first(std::min(part, left.size())));
      left = left.subspan(std::min(part, left.size()));
    }
  };
}

SampleEstimate quantile_of(const std::vector<double>& rising, double p) {
  return sample_quantile(quantile_ranks(rising.size(), p), [&](std::uint64_t rank) { return rising.at(rank); });
}

double spearman(const std::vector<double>& x, const std::vector<double>& y) {
  const RankScale first(column(x), x.size()), second(column(y), y.size());
  return rank_correlation([&](const TakePairs& take) { take(x, y); }, first, second);
}

template <class Function>
std::vector<double> evaluated(Function&& f, std::size_t parameters, const Saltelli& saltelli, std::uint64_t seed = 4) {
  Design design(saltelli, parameters, seed);
  std::vector<double> values;
  for (std::uint64_t k = 0; k < size(saltelli, parameters); ++k) values.push_back(f(design.point(k)));
  return values;
}

/// A function of numbers from (0, 1) with its exact Sobol indices.
struct Known {
  std::function<double(const std::vector<double>&)> of;
  std::vector<double> first, total;
};

const Known ishigami = [] {
  constexpr double pi = std::numbers::pi, a = 7.0, b = 0.1;
  const double pi4 = std::pow(pi, 4), variance = a * a / 8 + b * pi4 / 5 + b * b * pi4 * pi4 / 18 + 0.5;
  const double Vx = 0.5 * std::pow(1 + b * pi4 / 5, 2), Vy = a * a / 8, Vxz = b * b * pi4 * pi4 * 8 / 225;
  return Known{[=](const std::vector<double>& u) {
                 const double x = pi * (2.0 * u[0] - 1.0), y = pi * (2.0 * u[1] - 1.0), z = pi * (2.0 * u[2] - 1.0);
                 return std::sin(x) + a * std::sin(y) * std::sin(y) + b * z * z * z * z * std::sin(x);
               },
               {Vx / variance, Vy / variance, 0.0},
               {(Vx + Vxz) / variance, Vy / variance, Vxz / variance}};
}();
const Known ramp{[](const std::vector<double>& u) { return 7.0 + 3.0 * u[0] + 2.0 * u[1] + u[2]; },
                 {9.0 / 14, 4.0 / 14, 1.0 / 14},
                 {9.0 / 14, 4.0 / 14, 1.0 / 14}};
/// A step, as a count of events is one: 1 where both numbers are above 0.3.
const Known corner{[](const std::vector<double>& u) { return u[0] > 0.3 && u[1] > 0.3 ? 1.0 : 0.0; },
                   {0.49 * 0.21 / (0.49 * 0.51), 0.49 * 0.21 / (0.49 * 0.51)},
                   {1.0 - 0.21 / 0.51, 1.0 - 0.21 / 0.51}};

/// Indices within three standard errors of the exact ones, and these errors not so large that all is true.
void check_indices(const SobolIndices& indices, const std::vector<double>& first, const std::vector<double>& total) {
  const std::vector<SobolIndex>& found = indices.of;
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
  check_indices(sobol_indices(column(evaluated(ishigami.of, 3, Saltelli{8192})), Saltelli{8192}, 3), ishigami.first,
                ishigami.total);
}

TEST_CASE("Sobol indices of a linear model, far from zero", "[sweep]") {
  const auto linear = [](const std::vector<double>& u) { return 1e6 + 3.0 * u[0] + 2.0 * u[1] + u[2] + 0.0 * u[3]; };
  const std::vector<double> exact{9.0 / 14, 4.0 / 14, 1.0 / 14, 0.0};
  check_indices(sobol_indices(column(evaluated(linear, 4, Saltelli{4096})), Saltelli{4096}, 4), exact, exact);
}

TEST_CASE("intervals of Sobol indices contain the true value as often as stated", "[sweep]") {
  constexpr int designs = 1000;
  for (const auto& [function, samples] : {std::pair{&ishigami, 128}, {&ishigami, 1024}, {&ramp, 100}, {&corner, 256}}) {
    const std::size_t parameters = function->first.size();
    std::vector<int> first(parameters), total(parameters);
    for (std::uint64_t seed = 1; seed <= designs; ++seed) {
      const auto values = evaluated(function->of, parameters, Saltelli{static_cast<std::uint64_t>(samples)}, seed);
      const SobolIndices found = sobol_indices(column(values), Saltelli{}, parameters);
      for (std::size_t k = 0; k < parameters; ++k) {
        const auto holds = [](const SampleEstimate& e, double truth) { return e.low <= truth && truth <= e.high; };
        if (holds(found.of[k].first, function->first[k])) ++first[k];
        if (holds(found.of[k].total, function->total[k])) ++total[k];
      }
    }
    for (std::size_t k = 0; k < parameters; ++k) {
      INFO(samples << " samples, parameter " << k << ": " << first[k] << " and " << total[k] << " of " << designs);
      for (const int caught : {first[k], total[k]}) {
        CHECK(caught >= 0.90 * designs);
        CHECK(caught <= 0.98 * designs);
      }
    }
  }
}

TEST_CASE("second-order Sobol indices tell which parameters act together", "[sweep]") {
  const Saltelli design{8192, true};
  const SobolIndices found = sobol_indices(column(evaluated(ishigami.of, 3, design)), design, 3);
  check_indices(found, ishigami.first, ishigami.total);
  REQUIRE(found.pairs.size() == 3);
  for (const PairIndex& pair : found.pairs) {
    const double exact = pair.first == 0 && pair.second == 2 ? ishigami.total[2] : 0.0;
    INFO(pair.first << " with " << pair.second << ": " << pair.index.value << ", exactly " << exact);
    CHECK(pair.first < pair.second);
    CHECK(std::abs(pair.index.value - exact) < 1.5 * (pair.index.high - pair.index.value));
    CHECK(pair.index.high - pair.index.low < 0.1);
  }
  CHECK(sobol_indices(column(evaluated(ishigami.of, 3, Saltelli{64})), Saltelli{64}, 3).pairs.empty());

  // three that act together as well
  const Known product{[](const std::vector<double>& u) {
                        const double x = u[0] - 0.5, y = u[1] - 0.5, z = u[2] - 0.5;
                        return x + 6.0 * x * y + 12.0 * x * y * z;
                      },
                      {},
                      {}};
  const double own = 1.0 / 12, of_two = 36.0 / 144, of_three = 144.0 / 1728, all = own + of_two + of_three;
  const SobolIndices of_product = sobol_indices(column(evaluated(product.of, 3, design)), design, 3);
  check_indices(of_product, {own / all, 0.0, 0.0}, {1.0, (of_two + of_three) / all, of_three / all});
  const SampleEstimate& together = of_product.pairs.front().index;
  CHECK(std::abs(together.value - of_two / all) < 1.5 * (together.high - together.value));
}

TEST_CASE("intervals of second-order indices contain the true value as often as stated", "[sweep]") {
  constexpr int designs = 500;
  const Saltelli design{256, true};
  std::vector<int> caught(3);
  for (std::uint64_t seed = 1; seed <= designs; ++seed) {
    const SobolIndices found = sobol_indices(column(evaluated(ishigami.of, 3, design, seed)), design, 3);
    for (std::size_t k = 0; k < 3; ++k) {
      const PairIndex& pair = found.pairs[k];
      const double exact = pair.first == 0 && pair.second == 2 ? ishigami.total[2] : 0.0;
      caught[k] += pair.index.low <= exact && exact <= pair.index.high;
    }
  }
  for (const int count : caught) {
    INFO(count << " of " << designs);
    CHECK(count >= 0.90 * designs);
    CHECK(count <= 0.98 * designs);
  }
}

TEST_CASE("samples of a Saltelli design with a failed trial are left out, and counted", "[sweep]") {
  const auto linear = [](const std::vector<double>& u) { return 3.0 * u[0] + 2.0 * u[1]; };
  std::vector<double> values = evaluated(linear, 2, Saltelli{4096});
  for (std::size_t k = 0; k < values.size(); k += 37) values[k] = std::numeric_limits<double>::quiet_NaN();
  const SobolIndices found = sobol_indices(column(values), Saltelli{}, 2);
  check_indices(found, {9.0 / 13, 4.0 / 13}, {9.0 / 13, 4.0 / 13});
  CHECK(found.left_out == 443);  // every 37th of 16384 values fails, each in another sample
  CHECK(found.used == 4096 - 443);
  CHECK(sobol_indices(column(std::vector<double>(40, 1.0)), Saltelli{}, 2).of.empty());
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

TEST_CASE("the interval of a quantile contains the true value as often as stated", "[sweep]") {
  constexpr int experiments = 2000, n = 200;
  for (const double p : {0.05, 0.5, 0.95}) {
    int caught = 0;
    for (std::uint64_t e = 0; e < experiments; ++e) {
      std::vector<double> values;
      for (std::uint64_t k = 0; k < n; ++k)
        values.push_back(to_unit_interval(random_bits(e, SweepStream::draws, k, 0)[0]));
      std::sort(values.begin(), values.end());
      const SampleEstimate found = quantile_of(values, p);
      if (found.low <= p && p <= found.high) ++caught;
    }
    CHECK(caught >= 0.94 * experiments);   // conservative, so at least 95 % up to the noise of 2000
    CHECK(caught <= 0.985 * experiments);  // but no wider than it need be
  }
  std::vector<double> rising(101);
  std::iota(rising.begin(), rising.end(), 0.0);
  CHECK(quantile_of(rising, 0.5).value == 50.0);
  CHECK(close(quantile_of(rising, 0.955).value, 95.5, 1e-12));
  CHECK(std::isinf(quantile_of({1.0, 2.0, 3.0}, 0.99).high));
}

TEST_CASE("order statistics of a column are those of the sorted values", "[sweep]") {
  for (const std::uint64_t many : {100U, 5000U, 200'000U}) {  // few enough to be sorted, and too many
    std::vector<double> values{0.0, -0.0, -1e300, 1e300, 1e-310, -1e-310, 5.000000000000001};
    values.insert(values.end(), many, 5.0);  // more equal ones than are held at once
    for (std::uint64_t k = 0; k < many; ++k)
      values.push_back(std::exp(40.0 * to_unit_interval(random_bits(7, SweepStream::draws, k, 0)[0]) - 20.0) *
                       (k % 3 == 0 ? -1.0 : 1.0));
    const std::uint64_t n = values.size();
    const std::set<std::uint64_t> ranks{0, 1, 17, n / 3, n / 2, n / 2 + 1, n - 30, n - 2, n - 1};
    const auto found = order_statistics(column(values), n, ranks);
    std::sort(values.begin(), values.end());
    REQUIRE(found.size() == ranks.size());
    for (const auto& [rank, value] : found) CHECK(value == values[rank]);
  }
  for (const double range : {1e-12, 1e-3, 1e3, 1e300}) {  // values whose first bits agree, and others
    std::vector<double> values;
    for (std::uint64_t k = 0; k < 200'000; ++k)
      values.push_back(-7.0 + range * to_unit_interval(random_bits(8, SweepStream::draws, k, 0)[0]));
    const std::set<std::uint64_t> ranks{0, 1, 9'999, 100'000, 190'000, 199'998, 199'999};
    const auto found = order_statistics(column(values), values.size(), ranks);
    std::sort(values.begin(), values.end());
    for (const auto& [rank, value] : found) CHECK(value == values[rank]);
  }
  CHECK(order_statistics(column({3.0}), 1, {0}).at(0) == 3.0);
  CHECK(order_statistics(column({}), 0, {}).empty());
}

TEST_CASE("rank correlation depends on order alone, and equal values share ranks", "[sweep]") {
  const std::vector<double> rising{1.0, 2.0, 3.0, 4.0};
  CHECK(close(spearman(rising, {1.0, 8.0, 27.0, 64.0}), 1.0, 1e-15));
  CHECK(close(spearman(rising, {4.0, 3.0, 2.0, 1.0}), -1.0, 1e-15));
  CHECK(spearman(rising, {5.0, 5.0, 5.0, 5.0}) == 0.0);
  // ranks 1 2.5 2.5 4 against 1 2 3 4: 4.5 / sqrt(4.5 * 5)
  CHECK(close(spearman(rising, {1.0, 2.0, 2.0, 7.0}), 4.5 / std::sqrt(22.5), 1e-15));

  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<double> x, y, spread, narrow, ends;  // the last three rise with y
  for (std::uint64_t k = 0; k < 3000; ++k) {
    const auto bits = random_bits(9, SweepStream::draws, k, 0);
    x.push_back(to_unit_interval(bits[0]));
    y.push_back(std::round(1e6 * (0.3 * x.back() + to_unit_interval(bits[1]))) * 1e-6);
    spread.push_back(std::exp(500.0 * y.back()));
    narrow.push_back(1.0 + 1e-9 * y.back());
    ends.push_back(y.back() < 0.1 ? -infinite : y.back() > 1.2 ? infinite : y.back());
  }
  const double found = spearman(x, y);
  CHECK(found > 0.2);
  CHECK(spearman(x, spread) == found);
  CHECK(spearman(spread, x) == found);
  CHECK(spearman(x, narrow) == found);
  CHECK(close(spearman(ends, ends), 1.0, 1e-14));
  CHECK(close(spearman(x, ends), found, 0.01));
}

TEST_CASE("intervals of rank correlations contain the true one in 95 % of samples", "[sweep]") {
  // of a bivariate normal distribution with correlation c it is 6/pi asin(c/2) [Kruskal1958]
  for (const double c : {0.0, 0.5, -0.9}) {
    constexpr int samples = 1000;
    constexpr std::size_t n = 60;
    const double truth = 6.0 / std::numbers::pi * std::asin(0.5 * c);
    int within = 0;
    for (int s = 0; s < samples; ++s) {
      std::vector<double> x, y;
      for (std::uint64_t k = 0; k < n; ++k) {
        const auto bits = random_bits(11, SweepStream::draws, static_cast<std::uint64_t>(s), k);
        x.push_back(normal_quantile(to_unit_interval(bits[0])));
        y.push_back(c * x.back() + std::sqrt(1.0 - c * c) * normal_quantile(to_unit_interval(bits[1])));
      }
      const SampleEstimate found = rank_correlation_estimate(spearman(x, y), n);
      within += found.low <= truth && truth <= found.high;
    }
    INFO("correlation " << c);
    CHECK(std::abs(within - 0.95 * samples) < 4.0 * std::sqrt(0.95 * 0.05 * samples));
  }
  CHECK_FALSE(rank_correlation_estimate(1.0, 10).has_interval());
  CHECK_FALSE(rank_correlation_estimate(0.5, 3).has_interval());
}

TEST_CASE("rank correlation of more values than it stores is accurate enough", "[sweep]") {
  constexpr std::uint64_t n = 200'000;
  std::vector<double> x, y;
  std::vector<std::pair<double, std::size_t>> order_x, order_y;
  for (std::uint64_t k = 0; k < n; ++k) {
    const auto bits = random_bits(8, SweepStream::draws, k, 0);
    x.push_back(to_unit_interval(bits[0]));
    y.push_back(std::exp(x.back()) + 2.0 * to_unit_interval(bits[1]));
    order_x.emplace_back(x[k], k);
    order_y.emplace_back(y[k], k);
  }
  std::sort(order_x.begin(), order_x.end());
  std::sort(order_y.begin(), order_y.end());
  std::vector<double> rank(n);
  for (std::size_t k = 0; k < n; ++k) rank[order_x[k].second] = static_cast<double>(k);
  double squares = 0.0;  // of the differences of the ranks
  for (std::size_t k = 0; k < n; ++k) squares += std::pow(rank[order_y[k].second] - static_cast<double>(k), 2);
  const double all = static_cast<double>(n), exact = 1.0 - 6.0 * squares / (all * (all * all - 1.0));
  CHECK(exact > 0.3);
  CHECK(exact < 0.9);
  // Four values share a rank: errors of 1.1 at random against ranks that spread by 5.8e4, in 2e5 values and two
  // columns, have a deviation of 6e-8.
  CHECK(std::abs(spearman(x, y) - exact) < 3e-7);
}

}  // namespace wormdrive::test::sweep_statistics
