#include <cmath>
#include <set>

#include "catch.hpp"
#include "cli/program.hpp"
#include "diagnosis/break_in_data.hpp"
#include "diagnosis/points/break_in_points.hpp"
#include "diagnosis/points/point_diagnosis.hpp"
#include "simulation/load_scenario.hpp"

// Break-in tables as in fig. 7 of the paper: friction at rest, C1 and C2 from points with 3 % noise.

namespace wormdrive::test::diagnosis_break_in {

namespace {

struct Table {
  Scenario scenario;
  TorquePoints points;
};

Table table(const std::string& csv, const std::vector<std::string>& overrides) {
  const Folder folder;
  folder.write("b.csv", csv);
  Scenario scenario = load_scenario(shipped("fig07_break_in_07cm_forward.toml"), overrides, Purpose::look);
  TorquePoints points = break_in_points(read_break_in_table(folder / "b.csv", scenario), scenario);
  return {std::move(scenario), std::move(points)};
}

Diagnosis diagnosed(const Table& table) { return diagnose(table.scenario, table.points, std::nullopt); }

Estimate constant(const Table& table, const std::string& name) {
  for (const Estimate& e : identified_constants(table.points, table.scenario))
    if (e.field == name) return e;
  throw std::invalid_argument(name);
}

}  // namespace

TEST_CASE("C1, C2 and the friction at rest are identified from break-in points with 3 % noise") {
  int inside = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Table points = table(break_in_csv(0.25, 0.03, seed), {});
    const Estimate mu = constant(points, "mu_s"), C1 = constant(points, "C1"), C2 = constant(points, "C2");
    inside += mu.low <= 0.25 && 0.25 <= mu.high ? 1 : 0;
    CHECK(std::abs(mu.value - 0.25) <= 0.01);
    CHECK(std::abs(C1.value + 0.0471) <= 0.003);
    CHECK(std::abs(C2.value - 0.0837) <= 0.004);
  }
  CHECK(inside >= 33);  // of 40 intervals of 95 %: fewer in one of 1000 suites
}

TEST_CASE("break-in points of the scenario's own friction are adequate", "[slow]") {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const Diagnosis d = diagnosed(table(break_in_csv(0.25, 0.03, seed), {}));
    INFO("seed " << seed << ": " << d.sentence);
    CHECK(d.verdict == Verdict::adequate);
    CHECK(d.causes.empty());
  }
}

TEST_CASE("friction at rest that is not the scenario's is named, with the true value in its interval", "[slow]") {
  for (const unsigned seed : {1U, 2U}) {
    const Diagnosis d = diagnosed(table(break_in_csv(0.25, 0.03, seed), {"mesh.friction=0.2"}));
    INFO("seed " << seed << ": " << d.sentence);
    REQUIRE(d.causes.size() == 1);
    const std::set<std::string> members(d.classes.at(0).begin(), d.classes.at(0).end());
    CHECK(members == std::set<std::string>{"mesh_friction", "static_friction"});
    const Estimate& e = d.causes[0].parameters.at(0);
    CHECK((e.low <= 0.05 && 0.05 <= e.high));
  }
}

TEST_CASE("a wrong pressure angle is not claimed: friction takes it up as mu/cos(pressure angle)") {
  const Table points = table(break_in_csv(0.25, 0.03, 5), {"mesh.pressure_angle_deg=14.5"});
  const Diagnosis d = diagnosed(points);
  INFO(d.sentence);
  CHECK(d.sentence.find("pressure") == std::string::npos);
  for (const EstimatedEffect& cause : d.causes)
    CHECK((cause.effect == "mesh_friction" || cause.effect == "static_friction"));
  const double pi = std::acos(-1.0), same = 0.25 * std::cos(14.5 * pi / 180.0) / std::cos(20.0 * pi / 180.0);
  const Estimate mu = constant(points, "mu_s");
  CHECK((mu.low <= same && same <= mu.high));
}

}  // namespace wormdrive::test::diagnosis_break_in
