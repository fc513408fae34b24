#include <algorithm>
#include <string>
#include <variant>
#include <vector>

#include "catch.hpp"
#include "judge/judge.hpp"
#include "numbers.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/run_scenario.hpp"

// A day of scenarios/solar_tracker.toml, with its gusts of 20 ms, against the judge's arithmetic in 128 bits.

namespace wormdrive::test::events_solar_tracker {

namespace {

judge::Torque torque(const Signal& signal) {
  judge::Torque sum;
  for (const SignalTerm& term : signal.terms) {
    if (const auto* s = std::get_if<Staircase>(&term))
      for (double k = 0.0; k < s->steps; ++k) sum.push_back(judge::step(s->rise, s->start + k * s->interval));
    if (const auto* s = std::get_if<Sinusoid>(&term))
      sum.push_back(judge::sinusoid(s->amplitude, s->frequency, s->phase));
    if (const auto* s = std::get_if<Ramp>(&term)) sum.push_back(judge::ramp(s->rate, s->start, s->end));
  }
  return sum;
}

template <class Effect>
const Effect& effect(const Scenario& scenario) {
  return *std::get<std::optional<Effect>>(scenario.effects.list);
}

/// The same numbers for the judge: of effects those that this scenario has.
judge::Drive judged(const Scenario& scenario) {
  const auto& mesh = std::get<MeshParameters<double>>(scenario.mesh);
  judge::Drive drive;
  drive.i = mesh.i;
  drive.lambda = mesh.lambda;
  drive.phi_n = mesh.phi_n;
  drive.lw = mesh.lw;
  drive.lg = mesh.lg;
  drive.mu = mesh.mu;
  drive.Jw = mesh.Jw;
  drive.Jg = mesh.Jg;
  drive.motor = torque(scenario.motor);
  drive.load = torque(std::get<Signal>(scenario.load));
  drive.worm_coulomb = effect<WormCoulomb<double>>(scenario).torque;
  drive.worm_viscous = effect<WormViscous<double>>(scenario).coefficient;
  drive.gear_coulomb = effect<GearCoulomb<double>>(scenario).torque;
  const auto& rest = effect<StaticFriction<double>>(scenario);
  drive.static_friction = judge::StaticFriction{rest.rise, rest.growth_time};
  drive.end = scenario.run.duration;
  return drive;
}

int motion(const Observation& at) { return sign(at.mode.motion); }
int flank(const Observation& at) { return sign(at.mode.flank); }

}  // namespace

TEST_CASE("a day of the solar tracker: every solver has each event within 1e-9 s of 128-bit arithmetic", "[slow]") {
  Scenario scenario = load_scenario(WORMDRIVE_SCENARIOS "/solar_tracker.toml", {}, Purpose::run);
  judge::Judge<judge::Quad> judge(judged(scenario), 200'000, 2000);
  const auto& events = judge.run();
  REQUIRE(events.size() > 400);
  for (const auto& [solver, method] : {std::pair{SolverKind::cvode, Method::bdf},
                                       {SolverKind::cvode, Method::adams},
                                       {SolverKind::taylor, Method::bdf}}) {
    scenario.run.solver = solver;
    scenario.run.method = method;
    const Trajectory found = simulate_scenario(scenario);
    REQUIRE(found.events.size() == events.size());
    Deviation times;
    int other_modes = 0;
    for (std::size_t k = 0; k < events.size(); ++k) {
      times.add(found.events[k].t - events[k].t);
      const Observation& after = found.events[k].after;
      other_modes += motion(after) != events[k].after.motion || flank(after) != events[k].after.flank;
    }
    INFO(events.size() << " events, largest deviation " << times << " s");
    CHECK(other_modes == 0);
    CHECK(times <= 1e-9);
    Deviation angle;
    angle.add(found.rows.back().at.theta_g - static_cast<double>(judge.course().theta));
    CHECK(angle <= 1e-8);
  }
}

}  // namespace wormdrive::test::events_solar_tracker
