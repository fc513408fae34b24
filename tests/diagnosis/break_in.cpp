#include <cmath>
#include <set>

#include "catch.hpp"
#include "cli/program.hpp"
#include "diagnosis/break_in_points.hpp"
#include "diagnosis/point_diagnosis.hpp"
#include "diagnosis/break_in_data.hpp"
#include "scenarios/load_scenario.hpp"

// Break-in tables as in fig. 7 of the paper: friction at rest, C1 and C2 from points with 3 % noise.

using namespace wormdrive;
using namespace wormdrive::test;

namespace {

struct Found {
  Diagnosis diagnosis;
  std::vector<Estimate> constants;
  const Estimate& constant(const std::string& name) const {
    for (const Estimate& e : constants)
      if (e.field == name) return e;
    throw std::invalid_argument(name);
  }
};

Found found(const std::string& csv, const std::vector<std::string>& overrides) {
  const Folder folder;
  folder.write("b.csv", csv);
  const Scenario scenario = load_scenario(shipped("fig07_break_in_07cm_forward.toml"), overrides, Purpose::look);
  const TorquePoints points = break_in_points(read_break_in_table(folder / "b.csv", scenario), scenario);
  return {diagnose(scenario, points, std::nullopt), identified_constants(points, scenario)};
}

}  // namespace

TEST_CASE("break-in points of the scenario's own friction are adequate; mu_s, C1 and C2 are reported") {
  int inside = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const Found f = found(break_in_csv(0.25, 0.03, seed), {});
    INFO("seed " << seed << ": " << f.diagnosis.sentence);
    CHECK(f.diagnosis.causes.empty());
    const Estimate &mu = f.constant("mu_s"), &C1 = f.constant("C1"), &C2 = f.constant("C2");
    inside += mu.low <= 0.25 && 0.25 <= mu.high ? 1 : 0;
    CHECK(std::abs(mu.value - 0.25) <= 0.01);
    CHECK(std::abs(C1.value + 0.0471) <= 0.003);
    CHECK(std::abs(C2.value - 0.0837) <= 0.004);
  }
  CHECK(inside >= 17);  // of 20 intervals of 95 %: fewer in one of 1000 suites
}

TEST_CASE("friction at rest that is not the scenario's is named, with the true value in its interval") {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Found f = found(break_in_csv(0.25, 0.03, seed), {"mesh.friction=0.2"});
    INFO("seed " << seed << ": " << f.diagnosis.sentence);
    REQUIRE(f.diagnosis.causes.size() == 1);
    const std::string cause = f.diagnosis.causes[0].effect;
    CHECK((cause == "mesh_friction" || cause == "static_friction"));
    const Estimate& e = f.diagnosis.causes[0].parameters.at(0);
    CHECK((e.low <= 0.05 && 0.05 <= e.high));
    CHECK(std::abs(f.constant("mu_s").value - 0.25) <= 0.01);
  }
}

TEST_CASE("a wrong pressure angle is not claimed: friction takes it up as mu/cos(pressure angle)") {
  const Found f = found(break_in_csv(0.25, 0.03, 5, 20.0), {"mesh.pressure_angle_deg=14.5"});
  INFO(f.diagnosis.sentence);
  CHECK(f.diagnosis.sentence.find("pressure") == std::string::npos);
  for (const EstimatedEffect& cause : f.diagnosis.causes)
    CHECK((cause.effect == "mesh_friction" || cause.effect == "static_friction"));
  const double pi = std::acos(-1.0), same = 0.25 * std::cos(14.5 * pi / 180.0) / std::cos(20.0 * pi / 180.0);
  const Estimate& mu = f.constant("mu_s");
  CHECK((mu.low <= same && same <= mu.high));
}
