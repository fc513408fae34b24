#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "statistics/normal.hpp"
#include "sweep/rare/design_point.hpp"
#include "sweep/rare/importance_sampling.hpp"
#include "sweep/rare/subset_simulation.hpp"

// Small probabilities against closed forms and direct integration, which share nothing with what is judged.

namespace wormdrive::test::sweep_rare_events {

namespace {

double phi(double x) { return std::exp(-0.5 * x * x) / std::sqrt(2.0 * std::numbers::pi); }
double below(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

/// The integral of phi(v) f(v) from -a to a, by Simpson's rule.
template <class F>
double expected(double a, F&& f) {
  constexpr int parts = 20000;
  const double h = 2.0 * a / parts;
  double sum = 0.0;
  for (int k = 0; k <= parts; ++k) {
    const double v = -a + k * h;
    sum += (k == 0 || k == parts ? 1.0 : k % 2 == 1 ? 4.0 : 2.0) * phi(v) * f(v);
  }
  return sum * h / 3.0;
}

LimitState each(double (*g)(const NormalPoint&)) {
  return [g](const std::vector<NormalPoint>& points, const std::vector<std::uint64_t>&) {
    std::vector<double> states;
    for (const NormalPoint& u : points) states.push_back(g(u));
    return states;
  };
}
/// beta less the mean of the coordinates, scaled to unit variance: misses with Phi(-beta).
LimitState plane(double beta) {
  return [beta](const std::vector<NormalPoint>& points, const std::vector<std::uint64_t>&) {
    std::vector<double> states;
    for (const NormalPoint& u : points) {
      double sum = 0.0;
      for (const double x : u) sum += x;
      states.push_back(beta - sum / std::sqrt(static_cast<double>(u.size())));
    }
    return states;
  };
}

/// Four ways to miss, [Waarts2000]: 2.22e-3 as it is printed in the literature.
double four_branches(const NormalPoint& u) {
  const double bow = 3.0 + 0.1 * (u[0] - u[1]) * (u[0] - u[1]), sum = (u[0] + u[1]) / std::numbers::sqrt2;
  return std::min(
      {bow - sum, bow + sum, u[0] - u[1] + 7.0 / std::numbers::sqrt2, u[1] - u[0] + 7.0 / std::numbers::sqrt2});
}
double of_four_branches() {
  return 1.0 - expected(3.5, [](double v) { return 1.0 - 2.0 * below(-(3.0 + 0.2 * v * v)); });
}
/// Two design points, [DerKiureghianDakessian1998, ex. 1]: 3.02e-3.
double parabola(const NormalPoint& u) { return 5.0 - u[1] - 0.5 * (u[0] - 0.1) * (u[0] - 0.1); }
double of_parabola() {
  return expected(9.0, [](double v) { return below(-(5.0 - 0.5 * (v - 0.1) * (v - 0.1))); });
}
/// Everywhere alike: no design point. In two dimensions exp(-r^2/2) lies outside.
double circle(const NormalPoint& u) { return 25.0 - u[0] * u[0] - u[1] * u[1]; }

bool within(const RareEstimate& p, double truth, double deviations) {
  return std::abs(std::log(p.probability / truth)) <= deviations * p.variation;
}

}  // namespace

TEST_CASE("rare events: a plane at 2 to 5 deviations, in 2, 10 and 50 dimensions") {
  for (const std::size_t dimensions : {2, 10, 50})
    for (const double beta : {2.0, 3.0, 4.0, 5.0}) {
      INFO("beta " << beta << " in " << dimensions << " dimensions");
      const SubsetResult subset = subset_simulation(plane(beta), dimensions, {.seed = 7});
      CHECK(within(subset.estimate, below(-beta), 3.0));
      CHECK(subset.estimate.variation < 0.3);
      const DesignPoint design = find_design_point(plane(beta), dimensions, 0);
      REQUIRE(design.converged);
      CHECK(design.beta == Catch::Approx(beta).epsilon(1e-6));
      for (const double cosine : design.direction)
        CHECK(cosine == Catch::Approx(1.0 / std::sqrt(static_cast<double>(dimensions))).epsilon(1e-6));
      const RareEstimate importance = importance_sampling(plane(beta), design.point, {.seed = 7});
      CHECK(within(importance, below(-beta), 3.5));
      CHECK(importance.variation < 0.06);
    }
}

TEST_CASE("rare events: published problems with several ways to miss, and with none that is the most likely") {
  REQUIRE(of_four_branches() == Catch::Approx(2.22e-3).epsilon(0.005));
  REQUIRE(of_parabola() == Catch::Approx(3.02e-3).epsilon(0.005));
  CHECK(within(subset_simulation(each(four_branches), 2, {.seed = 3}).estimate, of_four_branches(), 3.0));
  CHECK(within(subset_simulation(each(parabola), 2, {.seed = 3}).estimate, of_parabola(), 3.0));
  CHECK(within(subset_simulation(each(circle), 2, {.seed = 3}).estimate, std::exp(-12.5), 3.0));
  CHECK_FALSE(find_design_point(each(circle), 2, 0).converged);
}

TEST_CASE("rare events: samples around one way to miss do not see the others, and the other method tells") {
  const SubsetResult subset = subset_simulation(each(four_branches), 2, {.seed = 5});
  const DesignPoint design = find_design_point(each([](const NormalPoint& u) {
                                                 return four_branches({u[0] + 1e-3, u[1]});
                                               }),
                                               2, 0);
  const RareEstimate importance = importance_sampling(each(four_branches), design.point, {.seed = 5});
  CHECK(importance.high < subset.estimate.low);
}

TEST_CASE("rare events: of many intervals 95 % hold the truth") {
  int subset_holds = 0, importance_holds = 0;
  constexpr int repeats = 200;
  for (std::uint64_t seed = 1; seed <= repeats; ++seed) {
    const RareEstimate subset = subset_simulation(plane(3.5), 3, {.per_level = 500, .seed = seed}).estimate;
    subset_holds += subset.low <= below(-3.5) && below(-3.5) <= subset.high ? 1 : 0;
    const RareEstimate importance =
        importance_sampling(plane(3.5), NormalPoint(3, 3.5 / std::sqrt(3.0)), {.samples = 500, .seed = seed});
    importance_holds += importance.low <= below(-3.5) && below(-3.5) <= importance.high ? 1 : 0;
  }
  INFO(subset_holds << " and " << importance_holds << " of " << repeats);
  CHECK(subset_holds >= 0.90 * repeats);
  CHECK(importance_holds >= 0.90 * repeats);
}

TEST_CASE("rare events: a limit state without values between here and the limit is told") {
  const LimitState stairs = each([](const NormalPoint& u) { return u[0] > 9.0 ? -1.0 : 1.0; });
  REQUIRE_THROWS_WITH(subset_simulation(stairs, 2, {}),
                      "comes no nearer to its limit than 1 (a share of 1 of the drives)");
}

TEST_CASE("rare events: how near drives come to a limit that none reaches is told, and how many do") {
  const LimitState bounded = each([](const NormalPoint& u) { return 5.0 - std::min(u[0], 4.0); });
  REQUIRE_THROWS_WITH(subset_simulation(bounded, 2, {}),  // beyond 4 deviations lie 3.2e-5
                      "comes no nearer to its limit than 1 (a share of 3e-05 of the drives)");
}

}  // namespace wormdrive::test::sweep_rare_events
