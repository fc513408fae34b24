#include <algorithm>
#include <cmath>
#include <iostream>
#include <numbers>

#include "catch.hpp"
#include "description/build.hpp"
#include "lively_drive.hpp"
#include "scenarios/random_effects.hpp"

// The derivatives of runs whose effects have states, through impacts and bends.

namespace wormdrive::test::events_sensitivity_states {

using namespace lively_drive;

TEST_CASE("series, CVODES and differences agree on the derivatives by every effect with states", "[slow]") {
  SECTION("a winding") {
    DcMotor<double> motor{12.0, 0.025};
    motor.inductance = 0.02;
    check_effect(motor);
  }
  SECTION("a current loop at the end of its supply, with a winding that warms up") {
    DcMotor<double> motor{4.0, 0.025};
    motor.inductance = 0.01;
    motor.current_bandwidth = 100.0;
    motor.supply_voltage = 6.0;
    motor.current_limit = 1.5;
    motor.heat_capacity = 0.05;
    motor.thermal_resistance = 20.0;
    motor.temperature_coefficient = 0.004;
    check_effect(motor);
  }
  SECTION("bristles") { check_effect(WormLuGre<double>{4e-3, 6e-3, 5.0, 0.05, 1e-5}); }
  SECTION("bristles between the teeth") {
    const auto drive = lively(effects(MeshLuGre<double>{300.0, 0.05}));
    auto by = in_table(continuous_parameters(drive), "mesh_lugre");
    for (const Parameter& p : in_table(continuous_parameters(drive), "mesh")) by.push_back(p);
    CHECK(check_derivatives("mesh_lugre", drive, by).reversals >= 3);
  }
  SECTION("a gearbox that warms up") { check_effect(GearboxHeat<double>{0.01, 1e-5, 0.02, 0.01, 50.0, 5.0}); }
  SECTION("a coupling that twists") { check_effect(LoadCoupling<double>{1e-4, 1.0, 1e-3}, 1e-5); }
}

TEST_CASE("series, CVODES and differences agree on the derivatives by stops, which impacts and bends meet", "[slow]") {
  SECTION("hard stops") {
    HardStops<double> stops;
    stops.low = -0.3;
    stops.high = 0.25;
    stops.restitution = 0.4;
    const auto drive = lively(effects(stops));
    auto by = in_table(continuous_parameters(drive), "hard_stops");
    REQUIRE(by.size() == 3);
    for (const Parameter& p : in_table(continuous_parameters(drive), "mesh")) by.push_back(p);
    check_derivatives("hard stops", drive, by);
  }
  SECTION("elastic stops") {
    EndStops stop;
    stop.low = -0.3;
    stop.high = 0.25;
    stop.stiffness = 10.0;
    stop.damping = 0.01;
    RigidDrive drive = lively();
    drive.load.terms.emplace_back(stop);
    check_derivatives("elastic stops", drive, in_table(continuous_parameters(drive), "mesh"));
  }
}

namespace {

void check_random_drives(int count) {
  int drives = 0, parameters = 0, changes = 0;
  Deviation series;
  for (int trial = 0; drives < count; ++trial) {
    near_ties::Dice dice(20261129, static_cast<std::uint64_t>(trial));
    const DrawnDrive drawn = draw_effects(dice);
    const auto scenario = unless_it_jams(drawn, {});
    if (!scenario) continue;
    INFO(trial);
    const RigidDrive drive{stated_mesh(*scenario), sum_of(scenario->load), scenario->effects, scenario->motor,
                           scenario->initial};
    if (!drive.effects.have_states()) continue;
    ++drives;
    const Timetable timetable(0.0, 3.0 * drawn.period, drawn.period / 50.0);
    const auto all = continuous_parameters(drive);
    auto settings = tight(taylor, 1e-12);
    settings.absolute_tolerance = scenario->run.solver_settings().absolute_tolerance;
    const Sensitivities found = sensitivities(drive, all, timetable, settings);
    settings.solver = SolverKind::cvode;
    const Sensitivities cvodes = sensitivities(drive, all, timetable, settings);
    REQUIRE(found.events.size() == cvodes.events.size());
    changes += static_cast<int>(found.events.size());
    const std::vector<double> none(found.events.size(), 0.0);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      const Deviation d = deviation(found, column, cvodes, column, none);
      CAPTURE(all[k].table, all[k].field, d);
      CHECK(d <= 1e-5);
      series.add(d.size);
      ++parameters;
    }
  }
  std::cout << drives << " drives, " << parameters << " parameters, " << changes
            << " changes of mode: series against CVODES " << series << "\n";
}

}  // namespace

TEST_CASE("series and CVODES agree on the derivatives of random drives with states, by every parameter", "[slow]") {
  check_random_drives(4);
}
TEST_CASE("so they do for fifty, in minutes", "[.][long]") { check_random_drives(50); }

}  // namespace wormdrive::test::events_sensitivity_states
