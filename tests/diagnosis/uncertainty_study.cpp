#include "diagnosis/report/uncertainty_study.hpp"

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "catch.hpp"
#include "cli/program.hpp"
#include "description/toml/write_scenario.hpp"
#include "diagnosis/data/read_recording.hpp"
#include "diagnosis/diagnose.hpp"
#include "simulation/load_scenario.hpp"
#include "sweep/study/load_study.hpp"

// What data leave open goes into a study that anybody can run.

namespace wormdrive::test::diagnosis_uncertainty_study {

TEST_CASE("the study of a diagnosis draws from the joint distribution that the data leave", "[slow]") {
  const std::string folder = WORMDRIVE_SCENARIOS;
  const Scenario scenario = load_scenario(folder + "/example_bench.toml", {}, Purpose::look);
  const Diagnosis d = diagnose(scenario, {read_recording(folder + "/example_bench.csv", scenario)}, {.threads = 2});
  const JointEstimate& u = d.uncertainty;
  const auto n = static_cast<Eigen::Index>(u.numbers.size());
  REQUIRE(n > 3);
  double strongest = 0.0;
  for (Eigen::Index a = 0; a < n; ++a)
    for (Eigen::Index b = 0; b < a; ++b)
      strongest =
          std::max(strongest, std::abs(u.correlation[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)]));
  CHECK(strongest > 0.3);

  const Folder out;
  out.write("extended.toml", to_toml(d.extended));
  const std::string text = uncertainty_study(d);
  CAPTURE(text);
  const Study study = read_study(text, out / "uncertainty.toml");
  REQUIRE(study.parameters.size() == u.numbers.size());
  Design design(study.design, study.parameters.size(), study.seed, study.strata);
  const auto trials = static_cast<Eigen::Index>(study.trials());
  Eigen::MatrixXd drawn(trials, n);
  for (Eigen::Index t = 0; t < trials; ++t) {
    std::vector<double> p = design.point(static_cast<std::uint64_t>(t));
    if (!study.strata) study.copula.apply(p);
    for (Eigen::Index k = 0; k < n; ++k) {
      const auto q = static_cast<std::size_t>(k);
      const double si = study.parameters[q].path.ends_with("_deg") ? unit::degree : 1.0;
      drawn(t, k) = quantile(study.parameters[q].distribution, p[q]) * si;
      drawn(t, k) = (drawn(t, k) - u.numbers[q].value) / u.numbers[q].standard_error;
    }
  }
  const Eigen::RowVectorXd mean = drawn.colwise().mean();
  const Eigen::MatrixXd about = drawn.rowwise() - mean;
  const Eigen::MatrixXd covariance = about.transpose() * about / static_cast<double>(trials - 1);
  const double error = 4.0 / std::sqrt(static_cast<double>(trials));
  for (Eigen::Index a = 0; a < n; ++a) {
    CAPTURE(u.effects[static_cast<std::size_t>(a)]);
    CHECK(std::abs(mean[a]) < error);
    for (Eigen::Index b = 0; b <= a; ++b)
      CHECK(std::abs(covariance(a, b) - u.correlation[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)]) <
            1.5 * error);
  }
  CHECK(out.run({"check", "extended.toml"}).exit == 0);
  out.write("uncertainty.toml", text);
  CHECK(out.run({"sweep", "uncertainty.toml", "-o", "s.h5", "-q", "--shard", "1/200"}).exit == 0);
}

}  // namespace wormdrive::test::diagnosis_uncertainty_study
