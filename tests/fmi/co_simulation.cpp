// An FMU that solves inside, in an importer that knows the standard only: the same run as `wormdrive run`, however long
// its steps are.
#include <fstream>
#include <iterator>
#include <thread>

#include "fmi/exported.hpp"
#include "fmi/stepper.hpp"
#include "simulation/run_scenario.hpp"

namespace wormdrive::test::fmi_co_simulation {

namespace {

const std::vector<std::string> loop{"--kind", "loop"};

double angle_at(const Trajectory& run, double t, double speed) {
  const auto after =
      std::lower_bound(run.rows.begin(), run.rows.end(), t - 1e-9, [](const Row& r, double at) { return r.t < at; });
  return after->at.theta_g + speed * (t - after->t);
}

/// Events within 1e-9 s and angles within 1e-8 rad at steps of 1 ms, and the same end from longer steps.
void agrees(const std::string& file, std::vector<std::string> overrides, std::size_t at_least) {
  INFO(file);
  overrides.emplace_back("run.relative_tolerance=1e-13");
  const Exported exported(file, overrides, loop);
  const Trajectory ours = simulate_scenario(exported.scenario);
  REQUIRE(ours.events.size() >= at_least);
  const double end = exported.scenario.run.duration, h = 1e-3;
  Stepper fine(*exported.fmu, end);
  double angle = 0.0, time = 0.0;
  std::size_t seen = 0, compared = 0;
  Point at{};
  for (long k = std::lround(end / h); k > 0; --k) {
    const Point next = fine.step(h);
    angle = std::max(angle, std::abs(next.angle - angle_at(ours, next.t, next.speed)));
    if (next.events > at.events && static_cast<std::size_t>(next.events) <= ours.events.size()) {
      time = std::max(time, std::abs(next.latest - ours.events[static_cast<std::size_t>(next.events) - 1].t));
      ++compared;
    }
    seen += static_cast<std::size_t>(next.events - at.events);
    at = next;
  }
  CHECK(seen == ours.events.size());
  CHECK(2 * compared >= at_least);
  CHECK(time < 1e-9);
  CHECK(angle < 1e-8);
  for (const double longer : {1e-2, 0.1}) {
    const Point coarse = Stepper(*exported.fmu, end).last(end, longer);
    INFO(longer);
    CHECK(coarse.events == at.events);
    CHECK(std::abs(coarse.angle - at.angle) < 1e-9);
    CHECK(std::abs(coarse.speed - at.speed) < 1e-9);
  }
}

/// Of good_scenario.
const std::string constant_motor = "[motor.torque]\nkind = \"constant\"\ntorque_Nm = -0.05\n";

/// Everything in it is late.
std::string delayed(const Folder& folder) {
  const std::string moved =
      edited(edited(good_scenario, constant_motor, ""), "[load]\nkind = \"constant\"\ntorque_Nm = 0.02\n",
             "[load]\nkind = \"gravity_arm\"\ntorque_Nm = 0.0196\nangle_offset_deg = 0\n");
  folder.write("delayed.toml", edited(moved, "[run]\nduration_s = 0.01\n", R"([controller]
kind = "pid"
sample_time_s = 2e-3
sample_offset_s = 5e-4
delay_samples = 1
integral_weight = 1e4
angle_weight = 4e2
speed_weight = 1
[reference]
kind = "sinusoid"
amplitude_rad = 0.14
frequency_Hz = 2
[effect.actuator_delay]
delay_s = 7e-4
[effect.actuator_lag]
time_constant_s = 1e-3
[effect.encoder_delay]
delay_s = 3e-3
[effect.torque_saturation]
limit_Nm = 0.2
[run]
duration_s = 0.5
report_interval_s = 1e-3
)"));
  return folder / "delayed.toml";
}

/// A loop whose torque meets a limit.
std::vector<std::string> limited(const std::string& anti_windup) {
  return {"run.duration_s=1",
          "metrics.from_s=0",
          "run.report_interval_s=1e-3",
          "effect.torque_saturation.limit_Nm=0.02",
          "controller.anti_windup=" + anti_windup,
          "sensor.shaft=worm"};
}

/// An importer that goes back to a kept state, or to one in bytes in another instance, makes the same bits.
void goes_back(const Exported& exported) {
  Stepper one(*exported.fmu, 0.4), other(*exported.fmu, 0.4);
  one.last(0.1234, 0.0617);
  fmi2FMUstate kept = nullptr;
  one.model.call<decltype(fmi2GetFMUstate)>("fmi2GetFMUstate", &kept);
  size_t size = 0;
  one.model.call<decltype(fmi2SerializedFMUstateSize)>("fmi2SerializedFMUstateSize", kept, &size);
  std::vector<char> bytes(size);
  one.model.call<decltype(fmi2SerializeFMUstate)>("fmi2SerializeFMUstate", kept, bytes.data(), size);
  const double then = one.t;
  const Point first = one.last(0.3, 0.0883);
  one.model.call<decltype(fmi2SetFMUstate)>("fmi2SetFMUstate", kept);
  one.t = then;
  const Point again = one.last(0.3, 0.0883);
  CHECK(again.angle == first.angle);
  CHECK(again.speed == first.speed);
  CHECK(again.events == first.events);
  one.model.call<decltype(fmi2FreeFMUstate)>("fmi2FreeFMUstate", &kept);

  fmi2FMUstate made = nullptr;
  other.model.call<decltype(fmi2DeSerializeFMUstate)>("fmi2DeSerializeFMUstate", static_cast<const char*>(bytes.data()),
                                                      size, &made);
  other.model.call<decltype(fmi2SetFMUstate)>("fmi2SetFMUstate", made);
  other.t = then;
  const Point elsewhere = other.last(0.3, 0.0883);
  CHECK(std::abs(elsewhere.angle - first.angle) < 1e-13);
  CHECK(std::abs(elsewhere.speed - first.speed) < 1e-13);
  CHECK(elsewhere.events == first.events);
  other.model.call<decltype(fmi2FreeFMUstate)>("fmi2FreeFMUstate", &made);
  bytes[size / 2] ^= 1;
  CHECK_THROWS_WITH(other.model.call<decltype(fmi2DeSerializeFMUstate)>(
                        "fmi2DeSerializeFMUstate", static_cast<const char*>(bytes.data()), size, &made),
                    "the bytes are no state of this FMU: they are damaged");
}

}  // namespace

TEST_CASE("co-simulation of fig. 9 makes its events, whatever the steps are") {
  agrees(shipped("fig09_switching.toml"), {"run.report_interval_s=1e-3"}, 12);
}

TEST_CASE("co-simulation of the closed loop of fig. 10 makes its events, whatever the steps are") {
  agrees(shipped("fig10_sliding_014rad_bare.toml"),
         {"run.duration_s=1", "metrics.from_s=0", "run.report_interval_s=1e-3"}, 4);
}

#if WORMDRIVE_ELASTIC_TEETH_INSIDE  // where CVODE can be linked into an FMU
TEST_CASE("co-simulation of elastic teeth makes every impact, and jams as the drive does") {
  agrees(shipped("fig09_backlash.toml"), {"run.duration_s=0.5", "run.report_interval_s=1e-3"}, 11);
  agrees(shipped("jam.toml"), {}, 30);
}

TEST_CASE("co-simulation of a closed loop around elastic teeth makes its impacts") {
  agrees(shipped("fig10_sliding_014rad_bare.toml"),
         {"run.duration_s=0.3", "metrics.from_s=0", "run.report_interval_s=1e-3",
          "effect.tooth_compliance.stiffness_N_per_m=1e6", "effect.tooth_compliance.damping_s_per_m=300",
          "effect.backlash.gap_deg=0.02"},
         4);
}
#endif

TEST_CASE("co-simulation takes the states of effects along, and shows them") {
  agrees(shipped("dc_motor.toml"), {"run.duration_s=1", "run.report_interval_s=1e-3"}, 4);
  agrees(shipped("current_loop.toml"), {"run.report_interval_s=1e-3"}, 2);
  agrees(shipped("presliding.toml"), {"run.report_interval_s=1e-3"}, 4);
  agrees(shipped("swinging_load.toml"), {"run.report_interval_s=1e-3"}, 7);
  agrees(shipped("hard_stop.toml"), {"run.report_interval_s=1e-3"}, 15);
  agrees(shipped("warm_hoist.toml"), {"run.report_interval_s=1e-3", "run.duration_s=25"}, 2);
  const Exported motor(shipped("dc_motor.toml"), {"run.duration_s=0.5", "run.relative_tolerance=1e-13"}, loop);
  Stepper stepper(*motor.fmu, 0.5);
  stepper.last(0.5, 0.1);
  const Observation end = simulate_scenario(motor.scenario).rows.back().at;
  CHECK(std::abs(end.winding->current) > 1.0);
  CHECK(std::abs(stepper.model.real("effect.dc_motor.current") - end.winding->current) < 1e-8);
  CHECK_FALSE(motor.fmu->references().contains("effect.dc_motor.temperature_rise"));
}

TEST_CASE("a parameter that would give an effect a state, or take it one, is refused in one line") {
  for (const auto& [stated, set] : {std::pair{"0", 1e-3}, {"1e-3", 0.0}}) {
    const Exported motor(shipped("dc_motor.toml"), {std::string("effect.dc_motor.inductance_H=") + stated});
    Instance model(*motor.fmu, "", fmi2CoSimulation);
    model.set("effect.dc_motor.inductance_H", set);
    CHECK_THROWS_WITH(
        model.call<decltype(fmi2EnterInitializationMode)>("fmi2EnterInitializationMode"),
        "with these parameters the effects have other states than the FMU describes; export the scenario with them");
  }
  // and is not forgotten where something was read in between
  const Exported loop_of_current(shipped("current_loop.toml"));
  Instance model(*loop_of_current.fmu, "", fmi2CoSimulation);
  model.call<decltype(fmi2EnterInitializationMode)>("fmi2EnterInitializationMode");
  model.set("effect.dc_motor.inductance_H", 0.0);
  const std::string why =
      "effect.dc_motor states current_bandwidth_Hz without inductance_H, against which the loop changes the current; "
      "add it";
  CHECK_THROWS_WITH(model.real("gear_speed"), why);
  CHECK_THROWS_WITH(model.call<decltype(fmi2ExitInitializationMode)>("fmi2ExitInitializationMode"), why);
}

TEST_CASE("co-simulation carries delays, a lag and late samples") {
  const Folder folder;
  agrees(delayed(folder), {}, 2);
}

TEST_CASE("co-simulation carries a map of the torque") {
  agrees(shipped("fig09_switching.toml"),
         {"run.report_interval_s=1e-3", "effect.torque_map.over=gear_angle", "effect.torque_map.shaft=gear",
          "effect.torque_map.scale=2", "effect.torque_map.angles_rad=[-1, -0.2, 0.1, 0.5, 1]",
          "effect.torque_map.torques_Nm=[0.005, -0.004, 0.005, -0.01, 0]"},
         8);
}

TEST_CASE("co-simulation takes anti-windup and an encoder on the worm along") {
  for (const char* method : {"back_calculation", "conditional", "model_recovery"}) {
    INFO(method);
    agrees(shipped("fig10_sliding_014rad_bare.toml"), limited(method), 4);
  }
}

TEST_CASE("the time constant of an anti-windup is a parameter of a loop, with the limit that a scenario has") {
  std::vector<std::string> stated = limited("back_calculation"), other = stated;
  stated.emplace_back("controller.tracking_time_s=0.02");
  other.emplace_back("controller.tracking_time_s=0.005");
  const std::string file = shipped("fig10_sliding_014rad_bare.toml");
  const Exported with(file, stated, loop), without(file, other, loop);
  const double end = 0.5;
  const auto end_of = [&](const Exported& exported, double tracking_time) {
    Stepper from(*exported.fmu, end);
    from.model.call<decltype(fmi2Reset)>("fmi2Reset");
    from.model.set("controller.tracking_time_s", tracking_time);
    from.model.call<decltype(fmi2SetupExperiment)>("fmi2SetupExperiment", 0, 0.0, 0.0, 1, end);
    from.model.call<decltype(fmi2EnterInitializationMode)>("fmi2EnterInitializationMode");
    from.model.call<decltype(fmi2ExitInitializationMode)>("fmi2ExitInitializationMode");
    return from.last(end, 0.1).angle;
  };
  REQUIRE(end_of(with, 0.005) == Stepper(*without.fmu, end).last(end, 0.1).angle);
  REQUIRE(end_of(with, 0.005) != Stepper(*with.fmu, end).last(end, 0.1).angle);
  REQUIRE_THROWS_WITH(end_of(with, 1e-4), Catch::Matchers::ContainsSubstring("must be at least the sample time"));
}

TEST_CASE("the angle that a loop measures is that of the shaft on which its encoder sits") {
  for (const bool on_worm : {false, true}) {
    const Exported exported(shipped("fig10_sliding_014rad_bare.toml"),
                            {"run.duration_s=1", "metrics.from_s=0", "effect.transmission_error.amplitude_deg=0.5",
                             "effect.transmission_error.phase_deg=30", "effect.encoder_scale.share=0.01",
                             std::string("sensor.shaft=") + (on_worm ? "worm" : "gear")},
                            loop);
    Stepper theirs(*exported.fmu, 1.0);
    for (int k = 0; k < 20; ++k) {
      const double gear = theirs.step(0.05).angle;
      const double advance = 0.5 * unit::degree * std::sin(gear + 30 * unit::degree);
      CHECK(std::abs(theirs.model.real("measured_angle") - 1.01 * (on_worm ? gear + advance : gear)) < 1e-12);
    }
  }
}

TEST_CASE("an FMU carries the tolerance and the longest step of its scenario") {
  const Exported exported(shipped("fig09_switching.toml"), {"run.absolute_tolerance=3e-17", "run.max_step_s=0.0125"},
                          loop);
  std::ifstream plant(exported.folder / "resources/plant.json");
  const std::string text((std::istreambuf_iterator<char>(plant)), {});
  CHECK(text.find("\"absolute_tolerance\": 3e-17") != std::string::npos);
  CHECK(text.find("\"max_step_s\": 0.0125") != std::string::npos);
}

TEST_CASE("a plant whose torque is set at communication points is a run under a table of these torques") {
  const Folder folder;
  folder.write(
      "held.toml",
      edited(edited(good_scenario, constant_motor,
                    "[motor.torque]\nkind = \"samples\"\ntimes_s = [0, 0.02, 0.05]\ntorques_Nm = [0.05, -0.1, 0]\n"),
             "[run]\nduration_s = 0.01\n",
             "[effect.actuator_lag]\ntime_constant_s = 2e-3\n[run]\nduration_s = 0.1\nreport_interval_s = "
             "1e-3\nrelative_tolerance = 1e-13\n"));
  const Exported exported(folder / "held.toml");
  const Trajectory ours = simulate_scenario(exported.scenario);
  Stepper theirs(*exported.fmu, 0.1);
  for (int k = 0; k < 100; ++k) {
    theirs.model.set("motor_torque", k < 20 ? 0.05 : k < 50 ? -0.1 : 0.0);
    const Point at = theirs.step(1e-3);
    CHECK(std::abs(at.angle - angle_at(ours, at.t, at.speed)) < 1e-8);
  }
  CHECK(theirs.model.integer("event_count") == static_cast<int>(ours.events.size()));
}

TEST_CASE("an importer that goes back to a kept state, or to one in bytes in another instance, makes the same bits") {
  const Folder folder;
  goes_back(Exported(shipped("fig09_switching.toml"), {}, loop));
  goes_back(Exported(delayed(folder), {}, loop));
  goes_back(Exported(shipped("dc_motor.toml"), {}, loop));
  goes_back(Exported(shipped("fig10_pid_014rad_bare.toml"), {"run.duration_s=1", "metrics.from_s=0"}, loop));
  goes_back(Exported(shipped("fig10_pid_014rad_bare.toml"), limited("back_calculation"), loop));
  goes_back(Exported(shipped("fig10_sliding_014rad_bare.toml"), limited("conditional"), loop));
  goes_back(Exported(shipped("fig10_sliding_014rad_bare.toml"), limited("model_recovery"), loop));
#if WORMDRIVE_ELASTIC_TEETH_INSIDE
  goes_back(Exported(shipped("jam.toml"), {}, loop));
#endif
}

TEST_CASE("steps that cannot be are refused and change nothing") {
  const Exported exported(shipped("fig09_switching.toml"), {}, loop);
  Stepper stepper(*exported.fmu, 1.0);
  const Point before = stepper.step(0.1);
  const auto step = [&](double from, double size) {
    stepper.model.call<decltype(fmi2DoStep)>("fmi2DoStep", from, size, fmi2Boolean{1});
  };
  CHECK_THROWS_WITH(step(0.1, 0.0), "the communication step 0 s must be greater than 0");
  CHECK_THROWS_WITH(step(0.1, -0.1), "the communication step -0.1 s must be greater than 0");
  CHECK_THROWS_WITH(step(0.1, std::nan("")), "the communication step nan s must be greater than 0");
  CHECK_THROWS_WITH(step(0.2, 0.1), "the communication point 0.2 s is not where the instance is, 0.1 s");
  CHECK_THROWS_WITH(step(0.1, 2.0), "the step ends at 2.1 s, after the stop time 1 s");
  CHECK_THROWS_WITH(stepper.model.call<decltype(fmi2NewDiscreteStates)>("fmi2NewDiscreteStates", nullptr),
                    "fmi2NewDiscreteStates must not be called in step mode");
  CHECK_THROWS_WITH(stepper.model.call<decltype(fmi2EnterInitializationMode)>("fmi2EnterInitializationMode"),
                    "fmi2EnterInitializationMode must not be called in step mode");
  CHECK_THROWS_WITH(stepper.model.set("mesh.friction", 0.2),
                    "parameters can be set before the end of the initialization mode only");
  CHECK_THROWS_WITH(stepper.model.call<decltype(fmi2GetReal)>("fmi2GetReal", nullptr, size_t{1}, nullptr),
                    "the list of value references is a null pointer");
  CHECK(stepper.model.real("gear_angle") == before.angle);
  double reached = 0.0;
  stepper.model.call<decltype(fmi2GetRealStatus)>("fmi2GetRealStatus", fmi2LastSuccessfulTime, &reached);
  CHECK(reached == 0.1);
  fmi2Status none = fmi2OK;
  CHECK(stepper.model.status<decltype(fmi2GetStatus)>("fmi2GetStatus", fmi2DoStepStatus, &none) == fmi2Discard);
  CHECK_THROWS_WITH(Instance(*exported.fmu), "this FMU is one for co-simulation");
}

TEST_CASE("a step in which the drive halts is discarded, with the time that it came to") {
  const Folder folder;
  folder.write("halts.toml", edited(edited(good_scenario, "kind = \"constant\"\ntorque_Nm = -0.05\n",
                                           "kind = \"ramp\"\nrate_Nm_per_s = 1e308\nstart_s = 0.05\n"),
                                    "duration_s = 0.01", "duration_s = 0.2"));
  const Exported exported(folder / "halts.toml", {}, loop);
  Stepper stepper(*exported.fmu, 0.2);
  fmi2FMUstate kept = nullptr;
  stepper.model.call<decltype(fmi2GetFMUstate)>("fmi2GetFMUstate", &kept);
  const auto step = [&](double from) {
    return stepper.model.status<decltype(fmi2DoStep)>("fmi2DoStep", from, 0.1, fmi2Boolean{1});
  };
  CHECK(step(0.0) == fmi2Discard);
  CHECK(stepper.model.log().starts_with("cannot go on at t = 0.05 s"));
  double reached = 0.0;
  fmi2Boolean terminated = fmi2False;
  stepper.model.call<decltype(fmi2GetRealStatus)>("fmi2GetRealStatus", fmi2LastSuccessfulTime, &reached);
  stepper.model.call<decltype(fmi2GetBooleanStatus)>("fmi2GetBooleanStatus", fmi2Terminated, &terminated);
  CHECK(std::abs(reached - 0.05) < 1e-12);
  CHECK(terminated == fmi2True);
  CHECK(step(reached) == fmi2Discard);
  stepper.model.call<decltype(fmi2SetFMUstate)>("fmi2SetFMUstate", kept);
  stepper.model.call<decltype(fmi2FreeFMUstate)>("fmi2FreeFMUstate", &kept);
  CHECK(stepper.step(0.04).angle == 0.0);
}

TEST_CASE("instances in threads of their own do not see each other") {
  const Exported exported(shipped("fig10_sliding_014rad_bare.toml"), {"run.duration_s=1", "metrics.from_s=0"}, loop);
  std::array<double, 4> ends{};
  std::vector<std::thread> threads;
  for (double& end : ends)
    threads.emplace_back([&] { end = Stepper(*exported.fmu, 0.3).last(0.3, &end == ends.data() ? 0.1 : 0.01).angle; });
  for (std::thread& thread : threads) thread.join();
  CHECK(ends[1] == ends[2]);
  CHECK(ends[1] == ends[3]);
  CHECK(std::abs(ends[0] - ends[1]) < 1e-9);
}

}  // namespace wormdrive::test::fmi_co_simulation
