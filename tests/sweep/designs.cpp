// Designs: what each promises of its points, and that any point can be asked for alone.
#include <filesystem>
#include <memory>
#include <set>
#include <thread>

#include "catch.hpp"
#include "numbers.hpp"
#include "sweep/studies.hpp"
#include "sweep/study/design.hpp"
#include "sweep/study/keyed_permutation.hpp"
#include "sweep/study/load_study.hpp"
#include "sweep/trial.hpp"

namespace wormdrive::test::sweep_designs {

namespace {

std::vector<std::vector<double>> points(const DesignSettings& settings, std::size_t parameters, std::uint64_t seed) {
  Design design(settings, parameters, seed);
  std::vector<std::vector<double>> all;
  for (std::uint64_t k = 0; k < size(settings, parameters); ++k) all.push_back(design.point(k));
  return all;
}

/// A smooth function of three numbers with mean 0.
double smooth(const std::vector<double>& u) {
  return (u[0] - 0.5) + 2.0 * (u[1] - 0.5) + (u[2] * u[2] - 1.0 / 3.0) + (u[0] - 0.5) * (u[2] - 0.5);
}

/// Root mean square error of the mean of smooth() over seeds.
template <class Sampled>
double error_of_mean() {
  double squares = 0.0;
  constexpr int seeds = 20;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    double mean = 0.0;
    for (const auto& u : points(Sampled{256}, 3, seed)) mean += smooth(u) / 256.0;
    squares += mean * mean / seeds;
  }
  return std::sqrt(squares);
}

}  // namespace

TEST_CASE("a keyed permutation meets every number once, and keys differ", "[sweep]") {
  for (const std::uint64_t n : {1, 2, 3, 7, 64, 65, 1000, 4097}) {
    const KeyedPermutation permutation(n, 5, 0), other(n, 5, 1);
    std::set<std::uint64_t> met;
    std::uint64_t same = 0;
    for (std::uint64_t k = 0; k < n; ++k) {
      met.insert(permutation(k));
      if (permutation(k) == other(k)) ++same;
    }
    CHECK(met.size() == n);
    CHECK(*met.rbegin() == n - 1);
    if (n > 50) CHECK(same < 10);
  }
}

TEST_CASE("a Latin hypercube uses every stratum of every parameter once", "[sweep]") {
  for (const std::uint64_t n : {1, 10, 97, 1024}) {
    const auto all = points(LatinHypercube{n}, 4, 3);
    for (std::size_t k = 0; k < 4; ++k) {
      std::set<int> strata;
      for (const auto& u : all) strata.insert(static_cast<int>(u[k] * static_cast<double>(n)));
      CHECK(strata.size() == n);
    }
  }
}

TEST_CASE("a correlated Latin hypercube uses every stratum once and has the stated correlations", "[sweep]") {
  Eigen::MatrixXd wanted = Eigen::MatrixXd::Identity(5, 5);  // the fourth is free
  const auto state = [&](int j, int k, double coefficient) { wanted(j, k) = wanted(k, j) = coefficient; };
  state(0, 2, 0.9);
  state(1, 2, -0.3);
  state(1, 4, -0.5);
  const Copula copula(wanted);
  for (const std::uint64_t n : {1, 2, 3, 5, 6, 97, 1024}) {
    const auto strata = std::make_shared<CorrelatedStrata>(n, copula, 3);
    Design design(LatinHypercube{n}, 5, 3, strata), free(LatinHypercube{n}, 5, 3);
    std::vector<std::vector<double>> scores(5);
    for (std::size_t k = 0; k < 5; ++k) {
      std::set<int> used;
      for (std::uint64_t trial = 0; trial < n; ++trial) {
        const std::vector<double> u = design.point(trial);
        used.insert(static_cast<int>(u[k] * static_cast<double>(n)));
        scores[k].push_back(normal_quantile(u[k]));
        if (k == 0 || k == 3) REQUIRE(u[k] == free.point(trial)[k]);
      }
      INFO(n << " trials, parameter " << k);
      REQUIRE(used.size() == n);
    }
    if (n < 97) continue;
    for (std::size_t j = 0; j < 5; ++j)
      for (std::size_t k = 0; k < j; ++k) {
        double product = 0.0, squares_j = 0.0, squares_k = 0.0;
        for (std::uint64_t trial = 0; trial < n; ++trial) {
          product += scores[j][trial] * scores[k][trial];
          squares_j += scores[j][trial] * scores[j][trial];
          squares_k += scores[k][trial] * scores[k][trial];
        }
        const double found = product / std::sqrt(squares_j * squares_k);
        const double asked = wanted(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(k));
        INFO(n << " trials, parameters " << j << " and " << k << ": " << found << " for " << asked);
        // accidents of random orders, 1/sqrt(n), are taken out wherever a parameter is correlated
        CHECK(std::abs(found - asked) < (j == 3 || k == 3 ? 4.0 / std::sqrt(n) : 2.0 / static_cast<double>(n) + 0.01));
      }
  }
}

TEST_CASE("a correlated Latin hypercube is the same in every process, and without correlations the same points",
          "[sweep]") {
  Eigen::MatrixXd wanted = Eigen::MatrixXd::Identity(2, 2);
  wanted(0, 1) = wanted(1, 0) = 0.7;
  const Copula copula(wanted);
  const auto shared = std::make_shared<CorrelatedStrata>(1000, copula, 5),
             own = std::make_shared<CorrelatedStrata>(1000, copula, 5);
  std::vector<std::vector<double>> found(1000);
  {
    std::vector<std::jthread> threads;
    for (std::uint64_t t = 0; t < 4; ++t)
      threads.emplace_back([&, t] {
        Design design(LatinHypercube{1000}, 2, 5, shared);
        for (std::uint64_t trial = t; trial < 1000; trial += 4) found[trial] = design.point(trial);
      });
  }
  Design alone(LatinHypercube{1000}, 2, 5, own);
  for (std::uint64_t trial = 0; trial < 1000; ++trial) {
    REQUIRE(alone.point(trial) == found[trial]);
    std::vector<double> u = found[trial];
    copula.undo(u);
    copula.apply(u);
    REQUIRE(std::abs(u[1] - found[trial][1]) < 1e-12);
  }
}

TEST_CASE("a Latin hypercube with correlations of 0 alone is one without", "[sweep]") {
  const auto strata = std::make_shared<CorrelatedStrata>(20, Copula(Eigen::MatrixXd::Identity(3, 3)), 5);
  Design stated(LatinHypercube{20}, 3, 5, strata), plain(LatinHypercube{20}, 3, 5);
  for (std::uint64_t trial = 0; trial < 20; ++trial) REQUIRE(stated.point(trial) == plain.point(trial));
}

TEST_CASE("the first 2^m points of a shifted Sobol sequence lie one in each interval of 2^-m", "[sweep]") {
  const auto all = points(SobolSequence{256}, 5, 9);
  for (std::size_t k = 0; k < 5; ++k) {
    std::set<int> strata;
    for (const auto& u : all) strata.insert(static_cast<int>(u[k] * 256.0));
    CHECK(strata.size() == 256);
  }
  CHECK(points(SobolSequence{4}, 5, 10) != std::vector(all.begin(), all.begin() + 4));
}

TEST_CASE("a Latin hypercube and a Sobol sequence find a mean better than independent draws", "[sweep]") {
  const double random = error_of_mean<MonteCarlo>(), latin = error_of_mean<LatinHypercube>(),
               sobol = error_of_mean<SobolSequence>();
  CHECK(std::abs(random - 0.045) < 0.02);  // deviation of smooth() over 16
  CHECK(latin < 0.2 * random);
  CHECK(sobol < 0.1 * random);
}

TEST_CASE("a Saltelli design has A, B, and A with one column of B; for pairs also B with one column of A", "[sweep]") {
  for (const bool pairs : {false, true}) {
    const auto all = points(Saltelli{8, pairs}, 3, 2);
    const std::size_t rows = pairs ? 8 : 5;
    REQUIRE(all.size() == 8 * rows);
    for (std::size_t j = 0; j < 8; ++j) {
      const auto &A = all[rows * j], &B = all[rows * j + 1];
      for (std::size_t k = 0; k < 3; ++k) {
        std::vector<double> mixed = A, other = B;
        mixed[k] = B[k];
        other[k] = A[k];
        CHECK(A[k] != B[k]);
        CHECK(all[rows * j + 2 + k] == mixed);
        if (pairs) CHECK(all[rows * j + 5 + k] == other);
      }
    }
  }
}

TEST_CASE("a grid has every combination, one at a time every parameter alone", "[sweep]") {
  const auto grid = points(Grid{{2, 3}}, 2, 0);
  CHECK(grid == std::vector<std::vector<double>>{
                    {0.25, 0.5 / 3}, {0.25, 0.5}, {0.25, 2.5 / 3}, {0.75, 0.5 / 3}, {0.75, 0.5}, {0.75, 2.5 / 3}});
  const auto alone = points(OneAtATime{{2, 1}, {0.5, 0.5}}, 2, 0);
  CHECK(alone == std::vector<std::vector<double>>{{0.5, 0.5}, {0.25, 0.5}, {0.75, 0.5}, {0.5, 0.5}});
}

TEST_CASE("a point does not depend on the order in which points are computed", "[sweep]") {
  const DesignSettings designs[] = {MonteCarlo{100}, LatinHypercube{100}, SobolSequence{100},
                                    Saltelli{20},    Grid{{4, 5, 5}},     OneAtATime{{30, 30, 39}, {0.5, 0.5, 0.5}},
                                    Shapley{25, {}}};
  for (const DesignSettings& settings : designs) {
    const auto forward = points(settings, 3, 11);
    Design design(settings, 3, 11);
    for (std::uint64_t k = 100; k-- > 0;) REQUIRE(design.point(k * 37 % 100) == forward[k * 37 % 100]);
    for (const auto& u : forward)
      for (const double x : u) REQUIRE((x > 0.0 && x < 1.0));
  }
}

TEST_CASE("in a design by levels a discrete parameter takes each value once, whatever its weight", "[sweep]") {
  const std::string text =
      edited(edited(good_study, "distribution = \"truncated_normal\"\nmean = 0.25\ndeviation = 0.05\nlow = 0.1\n",
                    "distribution = \"discrete\"\nvalues = [0.2, 0.3, 0.3, 0.25]\nweights = [0.99, 0, 0.01, 1e-30]\n"),
             "trials = 200", "levels = 4");
  const auto friction = [](const std::string& study) {
    const StudyFolder folder(study);
    const Study read = load_study(folder / "study.toml");
    std::vector<double> values;
    for (const Trial& trial : Trials(read)({0, read.trials()})) values.push_back(trial.parameters[0]);
    return values;
  };
  CHECK(friction(edited(text, "monte_carlo", "grid")) ==
        std::vector{0.2, 0.2, 0.2, 0.2, 0.3, 0.3, 0.3, 0.3, 0.25, 0.25, 0.25, 0.25});
  // the medians first, by the weights
  CHECK(friction(edited(text, "monte_carlo", "one_at_a_time")) == std::vector{0.2, 0.2, 0.3, 0.25, 0.2, 0.2, 0.2, 0.2});
}

TEST_CASE("every shipped study can be read", "[sweep]") {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(WORMDRIVE_SCENARIOS "/studies")) {
    if (entry.path().extension() != ".toml") continue;
    INFO(entry.path());
    CHECK(load_study(entry.path().string()).trials() > 0);
    ++files;
  }
  CHECK(files >= 1);
}

}  // namespace wormdrive::test::sweep_designs
