// An FMU in an importer that knows the standard only: the same run as `wormdrive run`, and an orderly life.
#include <cstdlib>
#include <filesystem>
#include <locale>

#include <malloc.h>

#include "catch.hpp"
#include "cli/bad_input.hpp"
#include "fmi/event_loop.hpp"
#include "fmi/exported.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/run_scenario.hpp"

namespace wormdrive::test::fmi_fmu {

namespace {

/// An importer with the locale of its user, which tests/decimal_comma.py makes.
[[maybe_unused]] const std::locale before =
    std::getenv("LOCPATH") ? std::locale::global(std::locale("")) : std::locale();

ImportedRun imported(const Exported& exported, double longest_step) {
  Instance instance(*exported.fmu);
  EventLoop loop(instance, exported.scenario.motor, longest_step);
  ImportedRun run = loop(exported.scenario.run.duration, exported.scenario.run.rows_every());
  CHECK(loop.zeros == 0);
  return run;
}

/// By how much two solvers of a drive may differ; forces of stiff teeth by their stiffness times what angles do.
struct Agreement {
  double event_time = 1e-9, angle = 1e-8, speed = 1e-8, force = 1e-6;  ///< [s, rad, rad/s, N]
};

/// The FMU makes the run that the program makes: the same events, of which there are some, and everything within the
/// tolerance.
void agrees(const std::string& file, const std::vector<std::string>& overrides, std::size_t at_least,
            const Agreement& within = {}, double longest_step = 1e-3) {
  INFO(file);
  Exported exported(file, overrides);
  Trajectory ours = simulate_scenario(exported.scenario);
  std::erase_if(ours.events, [](const Event& e) { return e.before.mode == e.after.mode; });  // of the gear alone
  const ImportedRun theirs = imported(exported, longest_step);
  const std::size_t events = ours.events.size();
  REQUIRE(events >= at_least);
  REQUIRE(theirs.events.size() == events);
  for (std::size_t k = 0; k < events; ++k) {
    const Event& a = ours.events[k];
    const ImportedEvent& b = theirs.events[k];
    INFO("event " << k << " at " << a.t << " and " << b.t);
    CHECK(std::abs(a.t - b.t) < within.event_time);
    CHECK(sign(a.before.mode.motion) == b.motion_before);
    CHECK(sign(a.before.mode.flank) == b.flank_before);
    CHECK(sign(a.after.mode.motion) == b.motion_after);
    CHECK(sign(a.after.mode.flank) == b.flank_after);
  }
  double angle = 0.0, speed = 0.0, force = 0.0;
  std::size_t compared = 0;
  for (const ImportedRow& row : theirs.rows) {
    const auto same = std::lower_bound(ours.rows.begin(), ours.rows.end(), row.t - 1e-12,
                                       [](const Row& r, double t) { return r.t < t; });
    if (same == ours.rows.end() || std::abs(same->t - row.t) > 1e-12) continue;
    ++compared;
    angle = std::max(angle, std::abs(same->at.theta_g - row.gear_angle));
    speed = std::max(speed, std::abs(same->at.omega_g - row.gear_speed));
    force = std::max(force, std::abs(same->at.normal_force - row.normal_force));
    CHECK(sign(same->at.mode.motion) == row.motion);
    CHECK(sign(same->at.mode.flank) == row.flank);
  }
  CHECK(compared + 2 >= theirs.rows.size());
  CHECK(angle < within.angle);
  CHECK(speed < within.speed);
  CHECK(force < within.force);
}

}  // namespace

TEST_CASE("an FMU of fig. 9 makes the events of fig. 9") { agrees(shipped("fig09_switching.toml"), {}, 12); }

TEST_CASE("an FMU takes its effects along") {
  agrees(shipped("fig09_switching.toml"),
         {"effect.worm_coulomb.torque_Nm=0.002", "effect.gear_coulomb.torque_Nm=0.003",
          "effect.worm_viscous.coefficient_Nms_per_rad=1e-5", "effect.stribeck.drop=0.05",
          "effect.stribeck.speed_m_per_s=0.1", "effect.static_friction.rise=0.02",
          "effect.torque_offset.torque_Nm=0.003", "effect.load_magnitude.share=0.1", "effect.load_angle.angle_deg=10",
          "effect.gear_inertia.inertia_kgm2=1e-4", "effect.encoder_offset.angle_rad=0.1"},
         12);
  agrees(shipped("fig09_switching.toml"),
         {"effect.torque_gain.share=0.1", "effect.cogging.amplitude_Nm=0.001", "effect.cogging.periods=3",
          "effect.cogging.phase_deg=20", "effect.friction_asymmetry.change=0.01",
          "effect.position_friction.amplitude=0.05", "effect.position_friction.phase_deg=0",
          "effect.friction_drift.share=0.1", "effect.friction_drift.time_s=2",
          "effect.load_spring.stiffness_Nm_per_rad=0.01", "effect.load_spring.angle_deg=0",
          "effect.gear_viscous.coefficient_Nms_per_rad=1e-4"},
         8);
  agrees(shipped("fig09_switching.toml"),
         {"effect.torque_map.speeds_rad_per_s=[-100, -30, 0, 40, 100]",
          "effect.torque_map.torques_Nm=[0.003, 0.002, 0, -0.002, -0.004]"},
         10);
  agrees(shipped("crank_press.toml"), {"run.relative_tolerance=1e-13", "run.duration_s=1.4"}, 6);
}

TEST_CASE("an FMU takes the states of its effects along: the importer integrates currents, heat and bristles") {
  std::vector<std::string> warm{"run.relative_tolerance=1e-13", "run.duration_s=1.5"};
  for (const std::string word :
       {"heat_capacity_J_per_K=2", "thermal_resistance_K_per_W=5", "temperature_coefficient_per_K=0.0039"})
    warm.push_back("effect.dc_motor." + word);
  agrees(shipped("dc_motor.toml"), warm, 5);
  agrees(shipped("current_loop.toml"), {"run.relative_tolerance=1e-13"}, 2, {}, 1e-5);
  agrees(shipped("presliding.toml"), {"run.relative_tolerance=1e-13", "motor.torque[0].phase_deg=-80"}, 4);
  agrees(shipped("swinging_load.toml"), {"run.relative_tolerance=1e-13", "run.duration_s=0.45"}, 4);
}

TEST_CASE("an FMU bounces off its stops, and comes to rest there") {
  agrees(shipped("hard_stop.toml"), {"run.relative_tolerance=1e-13", "run.duration_s=1.4"}, 7);
  agrees(shipped("hard_stop.toml"), {"run.relative_tolerance=1e-13", "effect.hard_stops.restitution=0"}, 3);
  // ever smaller bounces end, and do so where they end in a run
  Exported less(shipped("hard_stop.toml"), {"run.relative_tolerance=1e-13", "effect.hard_stops.restitution=0.3"});
  const Trajectory ours = simulate_scenario(less.scenario);
  const ImportedRun theirs = imported(less, 1e-3);
  CHECK(theirs.events.size() < 1.5 * static_cast<double>(ours.events.size()));
  CHECK(std::abs(theirs.rows.back().gear_angle - ours.rows.back().at.theta_g) < 1e-8);
}

TEST_CASE("an FMU of one mass counts what its effects take off it, and refuses what they leave nothing of") {
  const std::vector<std::string> lighter{"effect.worm_inertia.mass_kg=-0.5", "effect.gear_inertia.mass_kg=-20",
                                         "effect.worm_coulomb.force_N=25"};
  agrees(shipped("measured_servo_axis.toml"), lighter, 1);
  const Exported exported(shipped("measured_servo_axis.toml"), lighter);
  Instance instance(*exported.fmu);
  instance.set("effect.gear_inertia.mass_kg", -95.0);
  CHECK_THROWS_WITH(instance.call<decltype(fmi2EnterInitializationMode)>("fmi2EnterInitializationMode"),
                    "effect.worm_inertia leaves no mass that moves: 0.1089 + -0.5 kg");
}

TEST_CASE("an FMU of elastic teeth makes every impact") {
  agrees(shipped("fig09_backlash.toml"), {"run.duration_s=0.5", "run.relative_tolerance=1e-13"}, 11, {}, 1e-5);
}

TEST_CASE("an FMU jams as the drive does", "[slow]") {
  const double stiffness = 1e7 * 0.045;  // of the teeth, times the radius of the gear [N/rad]
  agrees(shipped("jam.toml"), {"run.relative_tolerance=1e-13"}, 10, {.force = stiffness * 1e-8}, 5e-5);
}

TEST_CASE("jumps of the load are events that the FMU announces, jumps of the torque events that it takes") {
  const Folder folder;
  const std::string motor = "[motor.torque]\nkind = \"constant\"\ntorque_Nm = -0.05\n";
  const std::string load = "kind = \"constant\"\ntorque_Nm = 0.02\n[run]\nduration_s = 0.01\n";
  folder.write("steps.toml",
               edited(edited(good_scenario, motor,
                             "[[motor.torque]]\nkind = \"staircase\"\nrise_Nm = -0.02\ninterval_s = 0.04\nsteps = 3\n"
                             "[[motor.torque]]\nkind = \"step\"\ntorque_Nm = 0.06\ntime_s = 0.2\n"),
                      load,
                      "kind = \"step\"\ntorque_Nm = 0.2\ntime_s = 0.07\n[effect.worm_coulomb]\ntorque_Nm = 0.03\n"
                      "[run]\nduration_s = 0.3\nrelative_tolerance = 1e-12\n"));
  agrees(folder / "steps.toml", {}, 2);
}

TEST_CASE("an importer that restarts its solver only where it is told follows a drive through steps of its torque") {
  agrees(shipped("measured_worm_drive.toml"), {"run.relative_tolerance=1e-12"}, 4);
}

TEST_CASE("a parameter that the importer sets is that of the scenario") {
  const Exported with(shipped("fig09_switching.toml"), {"effect.worm_coulomb.torque_Nm=0.001"});
  Instance changed(*with.fmu);
  changed.set("effect.worm_coulomb.torque_Nm", 0.004);
  changed.set("mesh.friction", 0.2);
  changed.set("mesh.lead_angle_rad", 0.08);
  changed.set("initial.gear_angle_rad", 0.3);
  EventLoop loop(changed, with.scenario.motor);
  const ImportedRun set = loop(1.0, 0.1);
  const Scenario same = load_scenario(
      shipped("fig09_switching.toml"),
      {"effect.worm_coulomb.torque_Nm=0.004", "mesh.friction=0.2", "initial.gear_angle_rad=0.3", "run.duration_s=1"},
      Purpose::run);
  Scenario stated = same;
  std::get<MeshParameters<double>>(stated.mesh).lambda = 0.08;
  const Trajectory ours = simulate_scenario(stated);
  CHECK(set.events.size() == ours.events.size());
  CHECK(std::abs(set.rows.back().gear_angle - ours.rows.back().at.theta_g) < 1e-8);
}

TEST_CASE("an FMU refuses what it cannot do, with a reason in the log") {
  const Exported exported(shipped("fig09_switching.toml"));
  CHECK_THROWS_WITH(Instance(*exported.fmu, "{0}"),
                    "the GUID {0} is not that of " + (exported.folder / "resources/plant.json"));
  Instance instance(*exported.fmu);
  CHECK_THROWS_WITH(instance.set("mesh.friction", -1.0), "mesh.friction = -1 is not an allowed value");
  CHECK_THROWS_WITH(instance.set("gear_angle", 1.0), "there is no variable with the value reference 0");
  CHECK_THROWS_WITH(instance.real("gear_angle"), "the instance is not initialized");
  CHECK_THROWS_WITH(instance.call<decltype(fmi2DoStep)>("fmi2DoStep", 0.0, 0.1, 0),
                    "fmi2DoStep must not be called before the initialization mode");
  instance.set("mesh.friction", 20.0);
  CHECK_THROWS_WITH(instance.call<decltype(fmi2EnterInitializationMode)>("fmi2EnterInitializationMode"),
                    Catch::Matchers::StartsWith("mesh.friction = 20 is not below mu_g = 13.4"));
  instance.call<decltype(fmi2Reset)>("fmi2Reset");
  CHECK(instance.real("mesh.friction") == 0.25);
}

TEST_CASE("a kept state brings an instance back") {
  const Exported exported(shipped("fig09_switching.toml"));
  Instance instance(*exported.fmu);
  instance.call<decltype(fmi2EnterInitializationMode)>("fmi2EnterInitializationMode");
  instance.call<decltype(fmi2ExitInitializationMode)>("fmi2ExitInitializationMode");
  fmi2FMUstate kept = nullptr;
  instance.call<decltype(fmi2GetFMUstate)>("fmi2GetFMUstate", &kept);
  const double x[] = {0.5, 1.0};
  instance.call<decltype(fmi2SetContinuousStates)>("fmi2SetContinuousStates", x, size_t{2});
  CHECK(instance.real("gear_angle") == 0.5);
  instance.call<decltype(fmi2SetFMUstate)>("fmi2SetFMUstate", kept);
  CHECK(instance.real("gear_angle") == 0.0);
  instance.call<decltype(fmi2FreeFMUstate)>("fmi2FreeFMUstate", &kept);
  CHECK(kept == nullptr);
}

TEST_CASE("1000 cycles of instantiate, run, reset, run and free leave nothing behind") {
  const Exported exported(shipped("fig09_switching.toml"));
  std::size_t after_warm_up = 0;
  for (int k = 0; k < 1000; ++k) {
    Instance instance(*exported.fmu);
    for (const double end : {0.02, 0.01}) {
      EventLoop loop(instance, exported.scenario.motor, 0.01);
      loop(end, end);
      instance.call<decltype(fmi2Reset)>("fmi2Reset");
    }
    if (k == 100) after_warm_up = mallinfo2().uordblks;
  }
  CHECK(mallinfo2().uordblks < after_warm_up + 20000);  // 22 bytes a cycle
}

TEST_CASE("an FMU that is loaded and unloaded leaves nothing behind") {
  const Exported exported(shipped("fig09_switching.toml"));
  const std::string library = exported.folder / "again.so";  // the other one stays loaded
  std::filesystem::copy_file(exported.folder / "binaries/linux64/wormdrive_fmu.so", library);
  std::size_t after_warm_up = 0;
  for (int k = 0; k < 50; ++k) {
    void* const loaded = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
    REQUIRE(loaded);
    REQUIRE(dlclose(loaded) == 0);
    if (k == 10) after_warm_up = mallinfo2().uordblks;
  }
  CHECK(mallinfo2().uordblks < after_warm_up + 20000);
}

TEST_CASE("the library of an FMU has every function of the standard and needs the C library alone") {
  const Exported exported(shipped("fig09_switching.toml"));
  for (const auto& [version, wanted] : {std::pair<std::string, int>{"fmi2", 44}, {"fmi3", 75}}) {
    std::ifstream header(WORMDRIVE_FMI_HEADERS + version + ".h");
    int functions = 0;
    for (std::string word; header >> word;) {
      if (!word.starts_with(version) || word.find('(') == std::string::npos) continue;
      const std::string name = word.substr(0, word.find('('));
      INFO(name);
      CHECK(exported.fmu->symbol(name.c_str()) != nullptr);
      ++functions;
    }
    CHECK(functions == wanted);
  }
  const Outcome needs =
      Process({"/usr/bin/objdump", "-p", exported.folder / "binaries/linux64/wormdrive_fmu.so"}, exported.folder.path())
          .wait();
  std::istringstream lines(needs.out);
  for (std::string line; std::getline(lines, line);)
    if (line.find("NEEDED") != std::string::npos && line.find("san.so") == std::string::npos) {  // a memory checker
      INFO(line);
      CHECK((line.find("libc.so") != std::string::npos || line.find("libm.so") != std::string::npos ||
             line.find("ld-linux") != std::string::npos));
    }
}

TEST_CASE("the description of an FMU keeps to the schema of FMI 2.0", "[reference]") {
  const std::string schema = WORMDRIVE_REFERENCE_DATA "/../fmi/fmi2ModelDescription.xsd", xmllint = "/usr/bin/xmllint";
  if (!std::filesystem::exists(schema)) {
    WARN("skipped: reference data not found");
    return;
  }
  for (const std::string name : {"fig09_switching", "fig09_backlash", "fig09_stribeck", "dc_motor", "presliding",
                                 "swinging_load", "warm_hoist", "hard_stop"}) {
    const Exported exported(shipped(name + ".toml"));
    const Outcome outcome =
        Process({xmllint, "--noout", "--schema", schema, "modelDescription.xml"}, exported.folder.path()).wait();
    INFO(outcome.err);
    CHECK(outcome.exit == 0);
  }
}

TEST_CASE("what cannot be an FMU is refused with a way out, and nothing is written") {
  check_rejected(
      Folder(),
      {{"a delay on its way to a controller outside",
        good_scenario + "[effect.encoder_delay]\ndelay_s = 1e-3\n",
        "s.toml: error: effect.encoder_delay needs a memory of the past, which only samples of a controller have: use "
        "--kind loop, or switch it off (effect.encoder_delay.on = false)",
        {"fmu", "s.toml"},
        true},
       {"a place that cannot be written",
        good_scenario,
        "wormdrive: cannot write nowhere/a.fmu.part: No such file or directory",
        {"fmu", "s.toml", "-o", "nowhere/a.fmu"},
        true,
        4}});
}

}  // namespace wormdrive::test::fmi_fmu
