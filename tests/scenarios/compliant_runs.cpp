#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "cli/program.hpp"
#include "compliant_drives.hpp"
#include "core/elastic/compliant_start.hpp"
#include "core/elastic/elastic_teeth.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/run_scenario.hpp"

// Scenarios whose effects make the teeth elastic.

namespace wormdrive::test::scenarios_compliant_runs {

using Catch::Matchers::ContainsSubstring;

namespace {

Scenario scenario(const std::string& name, const std::vector<std::string>& overrides = {}) {
  return load_scenario(shipped(name), overrides, Purpose::run);
}
const std::vector<std::string> stiff{"effect.tooth_compliance.stiffness_N_per_m=1e8",
                                     "effect.tooth_compliance.damping_s_per_m=1000"};

}  // namespace

TEST_CASE("a scenario runs the drive that its effects describe") {
  const Trajectory of = simulate_scenario(scenario("fig09_backlash.toml"));
  const auto same =
      run(compliant(table1(), fig9_load(), fig9_motor(), {HuntCrossley<double>{1e6, 300.0}, 0.02 * unit::degree}),
          Timetable(0, 2, 0.002), {0.0, {-60.0 * of.rows.front().at.teeth->deflection, 0.0, 0.0, 0.0}, {}},
          tight(bdf, 1e-10));
  REQUIRE(of.events.size() == same.events.size());
  for (std::size_t n = 0; n < of.events.size(); ++n) REQUIRE(of.events[n].t == same.events[n].after.t);
  REQUIRE(of.rows.back().at.teeth->omega_w == same.end.x[1]);
}

TEST_CASE("the damping that is stated selects the law, and without backlash the gap is closed") {
  const ToothContact<double> of =
      tooth_contact(effects(ToothCompliance<double>{1e6, std::nullopt, 30.0}, Backlash<double>{0.01}));
  REQUIRE(std::get<LimitedDamper<double>>(of.law).damping == 30.0);
  REQUIRE(of.backlash == 0.01);
  const ToothContact<double> other = tooth_contact(effects(ToothCompliance<double>{1e6, 7.0, std::nullopt}));
  REQUIRE(std::get<HuntCrossley<double>>(other.law).damping == 7.0);
  REQUIRE(other.stiffness() == 1e6);
  REQUIRE(other.backlash == 0.0);
}

TEST_CASE("a run begins with teeth that carry the load, at rest and at constant speed, without a blow") {
  const auto p = table1();
  for (const double tau_l : {0.2, -0.2})
    for (const double omega : {0.0, 0.5, -0.5}) {
      const auto rigid = entered(p, constant(tau_l), constant(0.0));
      const Mode moving{omega > 0 ? Motion::forward : Motion::backward, tau_l > 0 ? Flank::left : Flank::right};
      const double tau_m = omega == 0.0 ? 0.0 : -rigid.mesh().C(moving.product() * p.mu) * tau_l;
      auto d = compliant(p, constant(tau_l), constant(tau_m), {HuntCrossley<double>{1e6, 10.0}, 1e-3});
      d.enter(0.0);
      const auto x = carrying(d, 0.0, 0.3, omega);
      const auto r = run(d, Timetable(0, 0.1, 0.01), {0.0, x, {}});
      REQUIRE(r.events.empty());
      REQUIRE(std::abs(r.end.x[3] - omega) <= 1e-9);
      REQUIRE(std::abs(r.end.x[1] - 60.0 * omega) <= 1e-7);
    }
  auto idle = compliant(p, constant(0.0), constant(0.0), {HuntCrossley<double>{1e6, 10.0}, 1e-3});
  idle.enter(0.0);
  REQUIRE(carrying(idle, 0.0, 0.3, 0.0)[0] == 60.0 * 0.3);
}

TEST_CASE("where eq. 17 is violated the rigid drive refuses and elastic teeth jam: the worm stops, the table swings") {
  REQUIRE_THROWS_WITH(scenario("jam.toml", {"effect.tooth_compliance.on=false", "effect.backlash.on=false"}),
                      ContainsSubstring("violates eq. 17") &&
                          ContainsSubstring("or add [effect.tooth_compliance]: elastic teeth can jam"));
  const Trajectory of = simulate_scenario(scenario("jam.toml"));
  // The motor is off at 0.3 s. The table meets the left flank, and from there on jams the worm within a few ms.
  const auto hit = std::find_if(of.events.begin(), of.events.end(),
                                [](const Event& e) { return e.t > 0.3 && e.kind() == EventKind::impact; });
  REQUIRE(hit != of.events.end());
  REQUIRE(hit->after.mode.flank == Flank::left);
  const auto stop = std::find_if(hit, of.events.end(), [](const Event& e) { return e.kind() == EventKind::stop; });
  REQUIRE(stop != of.events.end());
  REQUIRE(stop->t - hit->t <= 0.005);
  REQUIRE(stop->after.omega_g > 0.8 * hit->after.omega_g);  // the table has hardly slowed down
  for (auto e = stop; e != of.events.end(); ++e) REQUIRE(e->after.mode.motion == Motion::stuck);
  const double speed = stop->after.omega_g;
  double back = 0.0;
  for (const Row& row : of.rows) back = std::min(back, row.at.omega_g);
  REQUIRE(back < -0.5 * speed);  // thrown back by the teeth, then to and fro across the gap
  REQUIRE(of.events.back().kind() == EventKind::gear_stop);
  REQUIRE(of.rows.back().at.omega_g == 0.0);
}

TEST_CASE("a worm that locks itself is followed with elastic teeth") {
  REQUIRE_THROWS_WITH(scenario("fig09_switching.toml", {"mesh.friction=14"}),
                      ContainsSubstring("only elastic teeth, [effect.tooth_compliance], allow it"));
  const Trajectory of = simulate_scenario(scenario("fig09_backlash.toml", {"mesh.friction=14"}));
  for (const Row& row : of.rows) REQUIRE(row.at.normal_force >= -1e-9);
}

TEST_CASE("a controller moves stiff teeth as it moves rigid ones") {
  const std::vector<std::string> brief{"run.duration_s=0.2", "run.solver=cvode", "metrics.from_s=0"};
  std::vector<std::string> elastic = brief;
  elastic.insert(elastic.end(), stiff.begin(), stiff.end());
  const std::string name = "fig10_sliding_014rad_loaded.toml";
  const Trajectory rigid = simulate_scenario(scenario(name, brief)), of = simulate_scenario(scenario(name, elastic));
  REQUIRE(of.rows.back().at.teeth);
  REQUIRE(!rigid.rows.back().at.teeth);
  double moved = 0.0;
  Deviation apart;
  for (const Row& row : rigid.rows) {
    moved = std::max(moved, std::abs(row.at.theta_g));
    const auto same =
        std::lower_bound(of.rows.begin(), of.rows.end(), row.t, [](const Row& r, double t) { return r.t < t; });
    if (same != of.rows.end() && same->t == row.t) apart.add(same->at.theta_g - row.at.theta_g);
  }
  INFO("moved " << moved << " rad, apart " << apart << " rad");
  REQUIRE(moved >= 0.01);
  REQUIRE(apart <= 1e-3 * moved);
}

}  // namespace wormdrive::test::scenarios_compliant_runs
