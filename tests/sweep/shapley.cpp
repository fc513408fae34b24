// Shapley effects against closed forms and against integrals over the distribution, of dependent parameters too.
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <regex>
#include <tuple>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "numbers.hpp"
#include "statistics/normal.hpp"
#include "sweep/studies.hpp"
#include "sweep/summary/shapley_effects.hpp"

namespace wormdrive::test::sweep_shapley {

namespace {

using Function = std::function<double(const std::vector<double>&)>;  ///< of the probabilities below the parameters

ShapleyEffects effects_of(const Function& f, const Shapley& design, std::size_t parameters, std::uint64_t seed) {
  Design points(design, parameters, seed);
  std::vector<double> values;
  for (std::uint64_t trial = 0; trial < size(design, parameters); ++trial) values.push_back(f(points.point(trial)));
  return shapley_effects([&](const TakeValues& take) { take(values); }, design, parameters, seed);
}

/// Three parameters of which the first and the last are correlated.
Copula correlated(double rho) {
  Eigen::Matrix3d matrix = Eigen::Matrix3d::Identity();
  matrix(0, 2) = matrix(2, 0) = rho;
  return Copula(matrix);
}

double ishigami(const std::vector<double>& u) {
  const auto angle = [&](std::size_t k) { return std::numbers::pi * (2.0 * u[k] - 1.0); };
  return std::sin(angle(0)) * (1.0 + 0.1 * std::pow(angle(2), 4)) + 7.0 * std::pow(std::sin(angle(1)), 2);
}

/// Of a parameter: Shapley effect, first-order and total Sobol index.
struct Exact {
  double share, first, total;
};

/// From the variance that is explained by every set of parameters, a set being a sum of 1, 2 and 4.
std::vector<Exact> by_definition(const std::map<unsigned, double>& explained) {
  std::vector<Exact> effects;
  const double variance_of_all = explained.at(7);
  for (unsigned own = 1; own < 8; own *= 2) {
    double sum = 0.0;
    for (const auto& [others, variance] : explained) {
      if (others & own) continue;
      const int size = std::popcount(others);
      sum += (explained.at(others | own) - variance) / (size == 1 ? 6.0 : 3.0);
    }
    effects.push_back(
        {sum / variance_of_all, explained.at(own) / variance_of_all, 1.0 - explained.at(7 & ~own) / variance_of_all});
  }
  return effects;
}

/// Those of Ishigami's function, by the midpoint rule over normal scores.
std::vector<Exact> ishigami_effects(double rho) {
  constexpr int steps = 400;
  constexpr double far = 8.5, width = 2.0 * far / steps;
  const auto score = [&](int k) { return -far + (k + 0.5) * width; };
  const auto weight = [&](int k) {
    return width * std::exp(-0.5 * score(k) * score(k)) / std::sqrt(2.0 * std::numbers::pi);
  };
  const auto angle = [](double z) { return std::numbers::pi * std::erf(z / std::numbers::sqrt2); };
  const double other = std::sqrt(1.0 - rho * rho);
  double mean = 0.0, square = 0.0, by_first = 0.0, by_last = 0.0;
  for (int a = 0; a < steps; ++a) {
    double given_first = 0.0, given_last = 0.0;
    for (int b = 0; b < steps; ++b) {
      const double x = angle(score(a)), y = angle(rho * score(a) + other * score(b));
      const double f = std::sin(x) * (1.0 + 0.1 * std::pow(y, 4)), g = std::sin(y) * (1.0 + 0.1 * std::pow(x, 4));
      given_first += weight(b) * f;
      given_last += weight(b) * g;
      square += weight(a) * weight(b) * f * f;
    }
    mean += weight(a) * given_first;
    by_first += weight(a) * given_first * given_first;
    by_last += weight(a) * given_last * given_last;
  }
  const double first = by_first - mean * mean, last = by_last - mean * mean, both = square - mean * mean,
               second = 49.0 / 8.0;
  return by_definition({{0, 0.0},
                        {1, first},
                        {2, second},
                        {4, last},
                        {3, first + second},
                        {6, last + second},
                        {5, both},
                        {7, both + second}});
}

/// 1 + 2 z1 + 3 z2 + z3 of normal scores.
double linear(const std::vector<double>& u) {
  return 1.0 + 2.0 * normal_quantile(u[0]) + 3.0 * normal_quantile(u[1]) + normal_quantile(u[2]);
}
/// [Owen2017]: correlated parameters share half of what either explains of the other one. [Kucherenko2012]: alone, each
/// explains what the metric covaries with it; where all others are known, it has the variance that they leave it.
std::vector<Exact> linear_effects(double rho) {
  const double variance = 4.0 + 9.0 + 1.0 + 2.0 * rho * 2.0, shared = 0.5 * rho * rho;
  const double first = 4.0 * (1.0 - shared) + 2.0 * rho + 1.0 * shared,
               last = 1.0 * (1.0 - shared) + 2.0 * rho + 4.0 * shared;
  const double free = 9.0 / variance, remains = (1.0 - rho * rho) / variance;
  return {{first / variance, (2.0 + rho) * (2.0 + rho) / variance, 4.0 * remains},
          {free, free, free},
          {last / variance, (1.0 + 2.0 * rho) * (1.0 + 2.0 * rho) / variance, remains}};
}

}  // namespace

TEST_CASE("from each place of a random order on all parameters are drawn anew, those before it stay", "[sweep]") {
  const Shapley design{500, {}};
  Design points(design, 4, 3);
  std::vector<int> first(4);
  for (std::uint64_t k = 0; k < design.permutations; ++k) {
    const std::vector<std::size_t> order = points.order(k);
    ++first[order[0]];
    const std::vector<double> drawn = points.point(5 * k), anew = points.point(5 * k + 1);
    for (std::size_t step = 1; step <= 4; ++step) {
      const std::vector<double> u = points.point(5 * k + step);
      for (std::size_t place = 0; place < 4; ++place) {
        const std::size_t parameter = order[place];
        CHECK(u[parameter] == (place + 1 < step ? drawn : anew)[parameter]);
        CHECK(drawn[parameter] != anew[parameter]);
      }
    }
  }
  for (const int count : first) CHECK(std::abs(count - 125) < 4.0 * std::sqrt(500 * 0.25 * 0.75));
}

TEST_CASE("dependent parameters that are drawn anew keep the correlations with those that stay", "[sweep]") {
  constexpr double rho = -0.8;
  const Shapley design{20000, correlated(rho)};
  Design points(design, 3, 5);
  for (std::uint64_t step = 0; step <= 3; ++step) {
    double product = 0.0, free = 0.0;
    for (std::uint64_t k = 0; k < design.permutations; ++k) {
      const std::vector<double> u = points.point(4 * k + step);
      product += normal_quantile(u[0]) * normal_quantile(u[2]) / 20000.0;
      free += normal_quantile(u[0]) * normal_quantile(u[1]) / 20000.0;
    }
    INFO("step " << step);
    CHECK(std::abs(product - rho) < 4.0 * std::sqrt((1.0 + rho * rho) / 20000.0));
    CHECK(std::abs(free) < 4.0 / std::sqrt(20000.0));
  }
}

TEST_CASE(
    "Shapley effects and Sobol indices of Ishigami's function and of a linear model, with correlations and without",
    "[sweep]") {
  for (const double rho : {0.0, 0.5, -0.9}) {
    const Shapley design{20000, correlated(rho)};
    for (const auto& [function, exact] :
         {std::pair{Function(ishigami), ishigami_effects(rho)}, std::pair{Function(linear), linear_effects(rho)}}) {
      const ShapleyEffects found = effects_of(function, design, 3, 7);
      REQUIRE(found.of.size() == 3);
      double sum = 0.0;
      for (std::size_t k = 0; k < 3; ++k) {
        const ShapleyEffect& effect = found.of[k];
        REQUIRE(effect.first);
        REQUIRE(effect.total);
        for (const auto& [estimate, value, precision] : {std::tuple{effect.share, exact[k].share, 0.01},
                                                         {*effect.first, exact[k].first, 0.02},
                                                         {*effect.total, exact[k].total, 0.02}}) {
          const double deviation = (estimate.high - estimate.low) / (2.0 * 1.96);
          INFO("correlation " << rho << ", parameter " << k << ": " << estimate.value << " +- " << deviation
                              << ", exactly " << value);
          CHECK(std::abs(estimate.value - value) <= 3.5 * deviation);
          CHECK(deviation < precision);
        }
        sum += effect.share.value;
      }
      CHECK(close(sum, 1.0, 1e-12));
    }
  }
  // of independent parameters, half of what two do together is the part of either [Owen2014]
  const std::vector<Exact> free = ishigami_effects(0.0);
  const double pi4 = std::pow(std::numbers::pi, 4), variance = 49.0 / 8 + pi4 / 50 + pi4 * pi4 / 1800 + 0.5;
  CHECK(close(free[2].share, 0.5 * pi4 * pi4 * 0.08 / 225 / variance, 1e-6));
}

TEST_CASE("intervals of Shapley effects and of their Sobol indices contain the true value as often as stated",
          "[sweep]") {
  constexpr int designs = 500;
  const Shapley design{200, correlated(0.5)};
  for (const auto& [function, exact] :
       {std::pair{Function(ishigami), ishigami_effects(0.5)}, std::pair{Function(linear), linear_effects(0.5)}}) {
    std::vector<int> caught(9);
    const auto holds = [](const SampleEstimate& e, double value) { return e.low <= value && value <= e.high; };
    for (std::uint64_t seed = 1; seed <= designs; ++seed) {
      const ShapleyEffects found = effects_of(function, design, 3, seed);
      for (std::size_t k = 0; k < 3; ++k) {
        caught[k] += holds(found.of[k].share, exact[k].share);
        caught[3 + k] += holds(found.of[k].first.value(), exact[k].first);
        caught[6 + k] += holds(found.of[k].total.value(), exact[k].total);
      }
    }
    for (const int count : caught) {
      INFO(count << " of " << designs);
      CHECK(count >= 0.90 * designs);
      CHECK(count <= 0.98 * designs);
    }
  }
}

TEST_CASE("a permutation without a value is left out, and a constant metric has no Shapley effects", "[sweep]") {
  const Shapley design{10, {}};
  std::vector<double> values(30);
  for (std::size_t k = 0; k < values.size(); ++k) values[k] = static_cast<double>(k * k % 7);
  values[4] = std::nan("");
  const auto column = [&](const TakeValues& take) { take(values); };
  const ShapleyEffects found = shapley_effects(column, design, 2, 1);
  CHECK(found.used == 9);
  CHECK(found.left_out == 1);
  std::fill(values.begin(), values.end(), 3.0);
  CHECK(shapley_effects(column, design, 2, 1).of.empty());
}

TEST_CASE("a parameter that comes first or last in fewer than two permutations has no such Sobol index", "[sweep]") {
  const ShapleyEffects found = effects_of(linear, {3, {}}, 3, 1);
  REQUIRE(found.of.size() == 3);
  const Design points(Shapley{3, {}}, 3, 1);
  for (std::size_t k = 0; k < 3; ++k) {
    int first = 0, last = 0;
    for (std::uint64_t permutation = 0; permutation < 3; ++permutation) {
      first += points.order(permutation).front() == k;
      last += points.order(permutation).back() == k;
    }
    CHECK(found.of[k].first.has_value() == (first >= 2));
    CHECK(found.of[k].total.has_value() == (last >= 2));
  }
}

TEST_CASE("correlations that only rounding keeps apart are rejected before any order needs them", "[sweep]") {
  // the last of these three is a sum of the others
  Eigen::Matrix3d matrix;
  for (const auto& [a, b, c] : {std::array{0.8, 0.936, 0.96}, {0.6, -0.6, 0.28}}) {
    matrix << 1.0, a, b, a, 1.0, c, b, c, 1.0;
    CHECK_FALSE(Copula::exists(matrix));
    matrix(0, 1) = matrix(1, 0) = a * (1.0 - 1e-9);
    matrix(0, 2) = matrix(2, 0) = b * (1.0 - 1e-9);
    REQUIRE(Copula::exists(matrix));
    const Copula copula(matrix);
    for (const std::vector<std::size_t>& order :
         {std::vector<std::size_t>{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}})
      CHECK_NOTHROW(copula.reordered(order));
  }
}

TEST_CASE("a Shapley sweep of dependent parameters is the same in shards, and its summary tells the effects",
          "[sweep]") {
  const StudyFolder folder(
      study_but("design = \"monte_carlo\"\ntrials = 200", "design = \"shapley\"\npermutations = 20") +
      "[[correlation]]\nbetween = [\"mesh.friction\", \"effect.worm_coulomb.torque_Nm\"]\ncoefficient = 0.5\n");
  REQUIRE(folder.sweep({"-o", "a.h5", "--threads", "1", "--referee", "1"}).exit == 0);
  for (const char* shard : {"1/2", "2/2"})
    REQUIRE(folder.sweep({"--shard", shard, "-o", fmt::format("s{}.h5", shard[0]), "--threads", "4"}).exit == 0);
  REQUIRE(folder.run({"merge", "s2.h5", "s1.h5", "-o", "b.h5"}).exit == 0);
  CHECK(folder.column("a.h5", "index").size() == 60);
  CHECK(folder.rows("a.h5") == folder.rows("b.h5"));

  const auto summary = folder.run({"summary", "a.h5", "--metric", "final_gear_speed"});
  INFO(summary.out);
  CHECK(std::regex_search(summary.out,
                          std::regex("mesh.friction +Shapley effect \\S+ \\[.*\\] +first \\S+ \\[.*\\] +total ")));
  const nlohmann::json all = nlohmann::json::parse(folder.run({"summary", "a.h5", "--json"}).out),
                       found = all["shapley"]["final_gear_speed"]["parameters"];
  CHECK(all["metrics"]["final_gear_speed"]["count"] == 20);  // one draw of each permutation
  CHECK(all["draws"] == 20);
  CHECK(summary.out.find("  draws    20 of these trials, of which limits and metrics tell") != std::string::npos);
  const double sum =
      found["mesh.friction"]["value"].get<double>() + found["effect.worm_coulomb.torque_Nm"]["value"].get<double>();
  CHECK(close(sum, 1.0, 1e-12));
  const std::vector<double> stored = read_column(open_hdf5(folder / "a.h5"), "summary/shapley/share");
  CHECK(std::find(stored.begin(), stored.end(), found["mesh.friction"]["value"].get<double>()) != stored.end());
  const std::string csv = folder.run({"export", "a.h5", "--what", "summary"}).out;
  for (const char* value : {"share", "first", "total"})
    CHECK(csv.find(fmt::format("shapley,mesh.friction,final_gear_speed,{},", value)) != std::string::npos);
  const std::vector<double> totals = read_column(open_hdf5(folder / "a.h5"), "summary/shapley/total_low");
  const double total_low = found["mesh.friction"]["total"]["low"];
  CHECK(std::find(totals.begin(), totals.end(), total_low) != totals.end());
}

}  // namespace wormdrive::test::sweep_shapley
