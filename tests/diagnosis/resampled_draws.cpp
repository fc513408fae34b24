// Draws from what data leave open, by fits to resampled data: the judge is the covariance of the fit, which takes no
// fit to other data.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "catch.hpp"
#include "cli/program.hpp"
#include "diagnosis/data/read_recording.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/recordings.hpp"
#include "simulation/load_scenario.hpp"

namespace wormdrive::test::diagnosis_resampled_draws {

namespace {

const std::string scenario_file = shipped("example_bench.toml"), data_file = shipped("example_bench.csv");

Diagnosis diagnosed(const DiagnosisSettings& settings) {
  const Scenario scenario = load_scenario(scenario_file, {}, Purpose::look);
  return diagnose(scenario, {read_recording(data_file, scenario)}, settings);
}

std::size_t lines_of(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

}  // namespace

TEST_CASE("draws of resampled data have the errors and correlations that are stated", "[slow]") {
  const Diagnosis d = diagnosed({.draws = 400, .threads = 2});
  const JointEstimate& u = d.uncertainty;
  const auto n = static_cast<Eigen::Index>(u.numbers.size());
  REQUIRE(n > 3);
  REQUIRE(u.draws.size() == 400);
  Eigen::MatrixXd z(400, n);
  for (std::size_t t = 0; t < 400; ++t)
    for (std::size_t k = 0; k < u.numbers.size(); ++k)
      z(static_cast<Eigen::Index>(t), static_cast<Eigen::Index>(k)) =
          (u.draws[t][k] - u.numbers[k].value) / u.numbers[k].standard_error;
  const Eigen::RowVectorXd mean = z.colwise().mean();
  const Eigen::MatrixXd about = z.rowwise() - mean, covariance = about.transpose() * about / 399.0;
  for (Eigen::Index a = 0; a < n; ++a) {
    CAPTURE(u.effects[static_cast<std::size_t>(a)], mean[a], covariance(a, a));
    CHECK(std::abs(mean[a]) < 4.0 / std::sqrt(400.0));
    CHECK(std::abs(std::sqrt(covariance(a, a)) - 1.0) < 4.0 / std::sqrt(2.0 * 400.0));
    for (Eigen::Index b = 0; b < a; ++b) {
      CAPTURE(u.effects[static_cast<std::size_t>(b)], covariance(a, b));
      CHECK(std::abs(covariance(a, b) - u.correlation[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)]) <
            5.0 / std::sqrt(400.0));
    }
  }
}

TEST_CASE("draws of a law that bends stay where the data leave them", "[slow]") {
  Scenario drive = nominal_arm();
  std::get<std::optional<Stribeck<double>>>(drive.effects.list) = Stribeck<double>{.drop = 0.25, .speed = 0.04};
  const Diagnosis d = diagnose(nominal_arm(), {record(drive)}, {.draws = 40, .threads = 2});
  INFO(d.sentence);
  const JointEstimate& u = d.uncertainty;
  REQUIRE(std::find(u.effects.begin(), u.effects.end(), "stribeck") != u.effects.end());
  for (std::size_t k = 0; k < u.numbers.size(); ++k) {
    double mean = 0.0, squares = 0.0;
    for (const std::vector<double>& draw : u.draws) mean += draw[k] / 40.0;
    for (const std::vector<double>& draw : u.draws) {
      const double z = (draw[k] - mean) / u.numbers[k].standard_error;
      CAPTURE(u.effects[k], u.numbers[k].field, z);
      CHECK(std::abs(z) < 5.0);
      squares += z * z;
    }
    CAPTURE(u.effects[k], squares, mean, u.numbers[k].value);
    if (u.effects[k] == "stribeck" || u.effects[k] == "mesh_friction") {  // the others are known by tolerances
      CHECK(squares / 40.0 > 0.4);
      CHECK(squares / 40.0 < 2.0);
    }
    CHECK(std::abs(mean - u.numbers[k].value) < 3.0 * u.numbers[k].standard_error);
  }
}

TEST_CASE("draws depend on the seed and on nothing else", "[slow]") {
  const std::vector<Recording> seen{record(nominal_arm(), {.duration = 6.0})};
  const auto drawn = [&](const DiagnosisSettings& settings) { return diagnose(nominal_arm(), seen, settings); };
  const Diagnosis one = drawn({.draws = 10, .threads = 1}), two = drawn({.draws = 20, .threads = 2}),
                  other = drawn({.seed = 2, .draws = 10, .threads = 2});
  REQUIRE(one.uncertainty.draws.size() == 10);
  CHECK(std::equal(one.uncertainty.draws.begin(), one.uncertainty.draws.end(), two.uncertainty.draws.begin()));
  CHECK(one.uncertainty.draws.front() != other.uncertainty.draws.front());
  CHECK(one.uncertainty.numbers.front().value == other.uncertainty.numbers.front().value);
}

TEST_CASE("the draws of a diagnosis are swept row by row, and do not outlast it", "[slow]") {
  const Folder folder;
  const std::vector<std::string> words{"diagnose", scenario_file, data_file, "-o", "out", "-q", "--no-pictures"};
  std::vector<std::string> with_draws = words;
  with_draws.insert(with_draws.end(), {"--draws", "12"});
  REQUIRE(folder.run(with_draws).exit == 0);
  const std::string csv = folder.read("out/draws.csv"), first = csv.substr(csv.find('\n') + 1);
  CHECK(lines_of(csv) == 13);
  const Outcome sweep = folder.run({"sweep", "out/uncertainty.toml", "-o", "risk.h5", "-q"});
  INFO(sweep.out << sweep.err);
  REQUIRE(sweep.exit == 0);
  REQUIRE(folder.run({"export", "risk.h5", "-o", "trials.csv"}).exit == 0);
  const std::string trials = folder.read("trials.csv");
  CHECK(lines_of(trials) == 13);
  const std::string number = first.substr(0, first.find(','));
  CAPTURE(trials, number);
  CHECK(trials.find(number.substr(0, 12)) != std::string::npos);

  REQUIRE(folder.run(words).exit == 0);
  CHECK_FALSE(std::filesystem::exists(folder / "out/draws.csv"));
  CHECK(folder.read("out/uncertainty.toml").find("draws.csv") == std::string::npos);
}

}  // namespace wormdrive::test::diagnosis_resampled_draws
