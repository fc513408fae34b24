// The design and the measures of Morris against his own test function and linear models.
#include <algorithm>
#include <cmath>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "numbers.hpp"
#include "sweep/studies.hpp"
#include "sweep/study/design.hpp"
#include "sweep/summary/elementary_effects.hpp"

namespace wormdrive::test::sweep_morris {

namespace {

/// What a function of the levels, counted from 0 to 1 as in the paper, comes to.
template <class Function>
MorrisScreening screened(const Morris& morris, std::size_t parameters, std::uint64_t seed, Function&& f) {
  Design design(morris, parameters, seed);
  std::vector<double> values;
  const auto levels = static_cast<double>(morris.levels);
  for (std::uint64_t trial = 0; trial < size(morris, parameters); ++trial) {
    std::vector<double> x = design.point(trial);
    for (double& v : x) v = (v * levels - 0.5) / (levels - 1.0);
    values.push_back(f(x));
  }
  return elementary_effects([&](const TakeValues& take) { take(values); }, morris, parameters, seed);
}

/// The function of 20 inputs of section 5 of Morris 1991, of which the first ten matter; beyond them the coefficients,
/// which he drew from a standard normal distribution, are left at their mean 0 so that effects have closed forms.
double morris_1991(const std::vector<double>& x) {
  std::vector<double> w;
  for (std::size_t k = 0; k < x.size(); ++k)
    w.push_back(k == 2 || k == 4 || k == 6 ? 2.0 * (1.1 * x[k] / (x[k] + 0.1) - 0.5) : 2.0 * (x[k] - 0.5));
  double y = 0.0;
  for (std::size_t i = 0; i < 10; ++i) y += 20.0 * w[i];
  for (std::size_t i = 0; i < 6; ++i)
    for (std::size_t j = i + 1; j < 6; ++j) y -= 15.0 * w[i] * w[j];
  for (std::size_t i = 0; i < 5; ++i)
    for (std::size_t j = i + 1; j < 5; ++j)
      for (std::size_t l = j + 1; l < 5; ++l) y -= 10.0 * w[i] * w[j] * w[l];
  return y + 5.0 * w[0] * w[1] * w[2] * w[3];
}

}  // namespace

TEST_CASE("along a trajectory every parameter changes once, by half of the levels", "[sweep]") {
  constexpr std::size_t parameters = 5;
  const Morris morris{400, 6};
  Design design(morris, parameters, 7);
  std::vector<std::vector<int>> met(parameters, std::vector<int>(6)), first(parameters, std::vector<int>(1));
  int rising = 0;
  for (std::uint64_t t = 0; t < morris.trajectories; ++t) {
    std::vector<double> before = design.point(t * (parameters + 1));
    std::set<std::size_t> changed;
    for (std::size_t step = 1; step <= parameters; ++step) {
      const std::vector<double> after = design.point(t * (parameters + 1) + step);
      std::size_t changes = 0;
      for (std::size_t k = 0; k < parameters; ++k) {
        ++met[k][static_cast<std::size_t>(after[k] * 6.0)];
        if (after[k] == before[k]) continue;
        ++changes;
        if (step == 1) ++first[k][0];
        rising += after[k] > before[k];
        changed.insert(k);
        REQUIRE(std::abs(std::abs(after[k] - before[k]) - 0.5) < 1e-15);
      }
      REQUIRE(changes == 1);
      before = after;
    }
    REQUIRE(changed.size() == parameters);
  }
  // each is as likely as the others, within four standard deviations
  CHECK(std::abs(rising - 1000) < 4.0 * std::sqrt(2000 * 0.25));
  for (std::size_t k = 0; k < parameters; ++k) {
    CHECK(std::abs(first[k][0] - 80) < 4.0 * std::sqrt(400 * 0.2 * 0.8));
    for (const int count : met[k]) CHECK(std::abs(count - 2000 / 6) < 5 * 4.0 * std::sqrt(400 / 6.0));
  }
}

TEST_CASE("elementary effects of a linear model are its coefficients", "[sweep]") {
  const Morris morris{10, 4};
  const MorrisScreening found =
      screened(morris, 3, 2, [](const std::vector<double>& x) { return 3.0 * x[0] - 2.0 * x[1] + 1e3; });
  // over a step of 1/2 of the probability the paper's levels change by 2/3
  REQUIRE(found.of.size() == 3);
  CHECK(close(found.of[0].mu, 4.0, 1e-12));
  CHECK(close(found.of[1].mu, -8.0 / 3.0, 1e-12));
  CHECK(close(found.of[1].mu_star.value, 8.0 / 3.0, 1e-12));
  CHECK(close(found.of[1].mu_star.low, 8.0 / 3.0, 1e-10));
  CHECK(std::abs(found.of[0].sigma) < 1e-10);
  CHECK(found.of[2].mu_star.value == 0.0);
}

TEST_CASE("the function of Morris 1991 shows what he found: which inputs matter, and in which way", "[sweep]") {
  const Morris morris{20000, 4};
  const MorrisScreening found = screened(morris, 20, 3, morris_1991);
  REQUIRE(found.of.size() == 20);
  CHECK(found.used == 20000);
  const double scale = 4.0 / 3.0;         // from changes of the paper's levels to those of the probability
  for (std::size_t k = 7; k < 10; ++k) {  // linear: 20 w, w = 2 (x - 1/2)
    CHECK(close(found.of[k].mu, scale * 40.0, 1e-9));
    CHECK(found.of[k].sigma < 1e-8);
  }
  for (std::size_t k = 10; k < 20; ++k) CHECK(found.of[k].mu_star.value == 0.0);
  // the seventh is curved: between levels 0 and 2/3, or 1/3 and 1, w changes by 2.2 (x / (x + 0.1))
  const auto w = [](double x) { return 2.0 * (1.1 * x / (x + 0.1) - 0.5); };
  const double steep = 20.0 * (w(2.0 / 3.0) - w(0.0)) / 0.5, flat = 20.0 * (w(1.0) - w(1.0 / 3.0)) / 0.5;
  const double sigma = 0.5 * (steep - flat), error = sigma / std::sqrt(20000.0);
  CHECK(std::abs(found.of[6].mu - 0.5 * (steep + flat)) < 4.0 * error);
  CHECK(close(found.of[6].sigma, sigma, 1e-3));
  // the sixth meets five others in products of two: 20 - 15 (w1 + ... + w5), of which those of w1, w2 and w4 have the
  // mean 0 and the variance 5/9, and those of w3 and w5 moments over the four levels
  double mean = 0.0, squares = 0.0;
  for (const double x : {0.0, 1.0 / 3.0, 2.0 / 3.0, 1.0}) {
    mean += w(x) / 4.0;
    squares += w(x) * w(x) / 4.0;
  }
  const double mu = scale * 2.0 * (20.0 - 15.0 * 2.0 * mean);
  const double deviation = scale * 2.0 * 15.0 * std::sqrt(3.0 * 5.0 / 9.0 + 2.0 * (squares - mean * mean));
  CHECK(std::abs(found.of[5].mu - mu) < 4.0 * deviation / std::sqrt(20000.0));
  CHECK(close(found.of[5].sigma, deviation, 0.03));
  CHECK(found.of[5].mu_star.low < found.of[5].mu_star.value);
  // he tells inputs 1 to 7 from 8 to 10 by sigma, and 11 to 20 from all by mu
  for (std::size_t k = 0; k < 7; ++k) CHECK(found.of[k].sigma > 10.0);
}

TEST_CASE("a trajectory without a value is left out", "[sweep]") {
  const Morris morris{5, 4};
  std::vector<double> values(size(morris, 2), 1.0);
  values[4] = std::nan("");
  const MorrisScreening found = elementary_effects([&](const TakeValues& take) { take(values); }, morris, 2, 1);
  CHECK(found.used == 4);
  CHECK(found.left_out == 1);
}

TEST_CASE("a Morris sweep is the same for any threads and shards, and its summary tells the effects", "[sweep]") {
  const StudyFolder folder(
      study_but("design = \"monte_carlo\"\ntrials = 200", "design = \"morris\"\ntrajectories = 8"));
  REQUIRE(folder.sweep({"-o", "a.h5", "--threads", "1", "--referee", "1"}).exit == 0);
  for (const char* shard : {"1/2", "2/2"})
    REQUIRE(folder.sweep({"--shard", shard, "-o", fmt::format("s{}.h5", shard[0]), "--threads", "4"}).exit == 0);
  REQUIRE(folder.run({"merge", "s2.h5", "s1.h5", "-o", "b.h5"}).exit == 0);
  CHECK(folder.column("a.h5", "index").size() == 24);
  CHECK(folder.rows("a.h5") == folder.rows("b.h5"));
  const Outcome summary = folder.run({"summary", "a.h5"});
  INFO(summary.out);
  CHECK(summary.out.find("mesh.friction                                mu* ") != std::string::npos);
  CHECK(summary.out.find("exact binomial") == std::string::npos);

  // mu, mu* and sigma again, from the columns alone
  const std::vector<double> friction = folder.column("a.h5", "mesh.friction"),
                            speed = folder.column("a.h5", "final_gear_speed");
  double mu = 0.0, mu_star = 0.0, squares = 0.0;
  for (std::size_t t = 0; t < 8; ++t)
    for (std::size_t k = 3 * t; k < 3 * t + 2; ++k) {
      if (friction[k + 1] == friction[k]) continue;
      const double effect = (speed[k + 1] - speed[k]) / (friction[k + 1] > friction[k] ? 0.5 : -0.5);
      mu += effect / 8.0;
      mu_star += std::abs(effect) / 8.0;
      squares += effect * effect;
    }
  const Hdf5Handle file = open_hdf5(folder / "a.h5");
  const std::vector<double> stored = read_column(file, "summary/morris/mu_star");
  REQUIRE(stored.size() == 12);  // six metrics, two parameters
  CHECK(close(stored[10], mu_star, 1e-12));
  const nlohmann::json found = nlohmann::json::parse(folder.run({"summary", "a.h5", "--json"}).out)["morris"];
  const nlohmann::json& of_friction = found["final_gear_speed"]["parameters"]["mesh.friction"];
  CHECK(close(of_friction["mu"], mu, 1e-12));
  CHECK(close(of_friction["mu_star"]["value"], mu_star, 1e-12));
  CHECK(close(of_friction["sigma"], std::sqrt((squares - 8.0 * mu * mu) / 7.0), 1e-9));
}

}  // namespace wormdrive::test::sweep_morris
