// A drive that is stepped goes to the bits of a run whose motor torque is a table of the same steps.
#include <cstring>
#include <random>

#include "catch.hpp"
#include "description/diagnostics.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/run_scenario.hpp"
#include "simulation/stepping/stepped_drive.hpp"

namespace wormdrive::test::stepping {
namespace {

Scenario shipped(const std::string& name, std::vector<std::string> overrides = {}) {
  return load_scenario(std::string(WORMDRIVE_SCENARIOS) + "/" + name, overrides, Purpose::run);
}

/// Torques that move fig. 9's drive in both directions and hold it now and then; the first is 0, as a stepped drive
/// begins.
std::vector<double> torques(std::size_t count, double largest, unsigned seed = 1) {
  std::mt19937 random(seed);
  std::vector<double> list{0.0};
  while (list.size() < count)
    list.push_back(random() % 4 == 0 ? 0.0 : largest * (2.0 * static_cast<double>(random() % 1001) / 1000.0 - 1.0));
  return list;
}

Scenario with_table(Scenario scenario, const std::vector<double>& list, double dt) {
  Samples table;
  table.interpolation = Interpolation::hold;
  for (std::size_t k = 0; k < list.size(); ++k) {
    table.times.push_back(static_cast<double>(k) * dt);
    table.values.push_back(list[k]);
  }
  scenario.control.reset();
  scenario.motor = {{table}};
  scenario.run.duration = static_cast<double>(list.size()) * dt;
  scenario.run.report_interval = scenario.run.duration;  // CVODE chooses its first step by how far the next row is
  return scenario;
}

struct Compared {
  std::size_t steps = 0;
  long events = 0;
};

/// Steps a scenario and compares every step's end with the run, to the last bit.
Compared compare(const Scenario& scenario, const std::vector<double>& list, double dt) {
  const Scenario run = with_table(scenario, list, dt);
  const Trajectory rows = simulate_scenario(run);
  const auto drive = make_stepped_drive(scenario);
  Compared compared;
  auto row = rows.rows.begin();
  for (const double torque : list) {
    drive->step(torque, dt);
    const StepState state = drive->state();
    while (row != rows.rows.end() && row->t < state.t) ++row;
    REQUIRE(row != rows.rows.end());
    REQUIRE(row->t == state.t);
    INFO("at " << state.t << " s");
    REQUIRE(row->at.theta_g == state.at.theta_g);
    REQUIRE(row->at.omega_g == state.at.omega_g);
    ++compared.steps;
  }
  const StepState end = drive->state();
  const Observation& last = rows.rows.back().at;
  CHECK(end.at.mode == last.mode);
  CHECK(end.at.alpha_g == last.alpha_g);
  CHECK(end.at.tau_m == last.tau_m);
  CHECK(end.at.tau_l == last.tau_l);
  CHECK(end.at.normal_force == last.normal_force);
  for (const long count : drive->events()) compared.events += count;
  CHECK(compared.events == static_cast<long>(rows.events.size()));
  return compared;
}

const std::vector<std::string> bearings{"effect.worm_coulomb.torque_Nm=0.004", "effect.gear_coulomb.torque_Nm=0.02",
                                        "effect.worm_viscous.coefficient_Nms_per_rad=1e-5"};

}  // namespace

TEST_CASE("stepping: the drive of fig. 9 goes to the bits of a run, by either solver", "[stepping]") {
  for (const std::string solver : {"cvode", "taylor"}) {
    INFO(solver);
    const Compared found =
        compare(shipped("fig09_switching.toml", {"run.solver=" + solver}), torques(150, 0.08), 0.013);
    CHECK(found.steps == 150);
    CHECK(found.events > 50);  // most of them inside of steps
  }
}

TEST_CASE("stepping: the same with effects in the bearings and in the friction", "[stepping]") {
  for (const std::string solver : {"cvode", "taylor"}) {
    INFO(solver);
    std::vector<std::string> with = bearings;
    with.push_back("run.solver=" + solver);
    CHECK(compare(shipped("fig09_switching.toml", with), torques(80, 0.1, 2), 0.021).events > 20);
    CHECK(compare(shipped("fig09_stribeck.toml", {"run.solver=" + solver}), torques(80, 0.08, 3), 0.017).events > 20);
  }
}

TEST_CASE("stepping: the same with elastic teeth and backlash", "[stepping]") {
  CHECK(compare(shipped("fig09_backlash.toml", {"run.relative_tolerance=1e-8"}), torques(25, 0.06), 0.011).events > 20);
}

TEST_CASE("stepping: the same under loads over time and over the angle, with knots inside of steps", "[stepping]") {
  Scenario scenario = shipped("fig09_switching.toml");
  scenario.load = Signal{{Step{.torque = 0.3, .time = 0.1234}, Sinusoid{.amplitude = 0.2, .frequency = 3.0}}};
  CHECK(compare(scenario, torques(60, 0.08, 4), 0.01).events > 10);
  scenario.run.solver = SolverKind::taylor;
  CHECK(compare(scenario, torques(60, 0.08, 4), 0.01).events > 10);
  Samples gusts;
  for (int k = 0; k < 40; ++k) {
    gusts.times.push_back(0.025 * k);  // on the steps' ends and between them
    gusts.values.push_back(0.1 * (k % 5 - 2));
  }
  for (const Interpolation kind : {Interpolation::hold, Interpolation::linear}) {
    gusts.interpolation = kind;
    scenario.load = Signal{{gusts}};
    CHECK(compare(scenario, torques(60, 0.08, 5), 0.0125).events > 10);
  }
  scenario.load = LoadSum{{AngleTable({-1.0, -0.2, 0.3, 1.0}, {0.1, -0.2, 0.3, 0.05})}};
  CHECK(compare(scenario, torques(60, 0.05, 6), 0.01).events > 10);
}

TEST_CASE("stepping: steps of several lengths end where they say", "[stepping]") {
  const auto drive = make_stepped_drive(shipped("fig09_switching.toml"));
  double t = 0.0;
  for (const double dt : {0.01, 0.01, 1e-6, 0.25, 0.01}) {
    drive->step(0.03, dt);
    CHECK(drive->time() == Catch::Approx(t += dt).epsilon(1e-15));
    CHECK(drive->state().t == drive->time());
  }
}

TEST_CASE("stepping: a drive goes on from a snapshot to the same bits, whatever its motor remembers", "[stepping]") {
  const std::vector<std::vector<std::string>> memories{
      {},
      {"run.solver=taylor"},
      {"effect.torque_saturation.limit_Nm=0.03"},
      {"effect.actuator_delay.delay_s=0.0313"},
      {"effect.actuator_lag.time_constant_s=0.02"},
      {"effect.actuator_delay.delay_s=0.017", "effect.actuator_lag.time_constant_s=0.05",
       "effect.torque_saturation.limit_Nm=0.05"}};
  const std::vector<double> list = torques(90, 0.08, 7);
  for (const auto& memory : memories)
    for (const std::string name : {"fig09_switching.toml", "fig09_backlash.toml"}) {
      if (name == "fig09_backlash.toml" && !memory.empty() && memory[0] == "run.solver=taylor") continue;
      std::vector<std::string> overrides = memory;
      overrides.push_back("run.relative_tolerance=1e-7");
      const Scenario scenario = shipped(name, overrides);
      INFO(name << (memory.empty() ? "" : memory[0]));
      const auto drive = make_stepped_drive(scenario), copy = make_stepped_drive(scenario);
      const std::size_t kept_at = name == "fig09_backlash.toml" ? 12 : 47, end = kept_at + 20;
      for (std::size_t k = 0; k < kept_at; ++k) drive->step(list[k], 0.0105);
      const std::vector<double> snapshot = drive->snapshot();
      copy->step(0.07, 0.3);  // what it did before is forgotten
      copy->restore(snapshot);
      CHECK(copy->snapshot() == snapshot);
      CHECK(copy->events() == drive->events());
      for (std::size_t k = kept_at; k < end; ++k) {
        drive->step(list[k], 0.0105);
        copy->step(list[k], 0.0105);
        REQUIRE(copy->snapshot() == drive->snapshot());
        REQUIRE(copy->state().at.tau_m == drive->state().at.tau_m);
        REQUIRE(copy->state().at.normal_force == drive->state().at.normal_force);
      }
      drive->reset();
      copy->reset();
      CHECK(drive->time() == 0.0);
      CHECK(drive->snapshot() == make_stepped_drive(scenario)->snapshot());
    }
}

TEST_CASE("stepping: a motor with a lag follows its closed form", "[stepping]") {
  const auto drive = make_stepped_drive(shipped("fig09_switching.toml", {"effect.actuator_lag.time_constant_s=0.02"}));
  double torque = 0.0;
  for (const double held : {0.05, -0.02, 0.01}) {
    for (int k = 0; k < 7; ++k) {
      drive->step(held, 0.003);
      torque = held + (torque - held) * std::exp(-0.003 / 0.02);
      CHECK(drive->state().at.tau_m == Catch::Approx(torque).margin(1e-16));
    }
  }
}

TEST_CASE("stepping: what a step cannot be, and what a snapshot is not, is said in one line", "[stepping]") {
  const auto drive = make_stepped_drive(shipped("fig09_switching.toml"));
  CHECK_THROWS_WITH(drive->step(std::nan(""), 0.01), "step: error: torque = nan must be a finite number");
  CHECK_THROWS_WITH(drive->step(0.0, 0.0), "step: error: dt = 0 s must be a finite number greater than 0");
  drive->step(0.0, 1.0);
  CHECK_THROWS_WITH(drive->step(0.0, 1e-17),
                    "step: error: dt = 1e-17 s is less than time resolves at 1 s; reset() starts at 0 again");
  const std::vector<double> none{1.0, 2.0};
  CHECK_THROWS_WITH(drive->restore(none), "snapshot: error: is none, or of another version of wormdrive");
  std::vector<double> other = make_stepped_drive(shipped("fig09_stribeck.toml"))->snapshot();
  CHECK_THROWS_WITH(drive->restore(other), "snapshot: error: is of a drive with another scenario");
  std::vector<double> cut = drive->snapshot();
  cut.pop_back();
  CHECK_THROWS_WITH(drive->restore(cut), "snapshot: error: is damaged");
  CHECK(drive->time() == 1.0);  // nothing has changed
}

TEST_CASE("stepping: what a scenario states in vain is told", "[stepping]") {
  CHECK(set_aside(shipped("fig09_switching.toml")) ==
        std::vector<std::string>{"[motor.torque] is not used: every step states the torque of the motor"});
  const auto told = set_aside(shipped("fig10_sliding_014rad_bare.toml", {"effect.encoder_delay.delay_s=0.001"}));
  REQUIRE(told.size() == 2);
  CHECK(told[0] ==
        "[controller], its reference, sensor and disturbance are not used: every step states the torque of the motor");
  CHECK(told[1] == "[effect.encoder_delay] is not used: a step shows the drive, not what a sensor sees of it");
}

}  // namespace wormdrive::test::stepping
