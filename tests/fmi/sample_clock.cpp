// The clock of FMI 3.0 that ticks with the samples of the controller in a loop: an importer that asks for its times and
// activates it takes the samples of `wormdrive run`, and one that does not gets the same run.
#include "fmi/exported.hpp"
#include "fmi/importer3.hpp"
#include "simulation/run_scenario.hpp"

namespace wormdrive::test::fmi_sample_clock {

namespace {

const std::vector<std::string> loop3{"--kind", "loop", "--fmi", "3"};

/// An importer whose event mode is where clocks tick.
struct Clocked : Instance3 {
  explicit Clocked(const Fmu& fmu) : Instance3(fmu, true, true, true) {}
  void begin(double end) {
    call<decltype(fmi3EnterInitializationMode)>("fmi3EnterInitializationMode", false, 0.0, 0.0, true, end);
    at = clock();
    call<decltype(fmi3ExitInitializationMode)>("fmi3ExitInitializationMode");
  }
  void enter_events() { call<decltype(fmi3EnterEventMode)>("fmi3EnterEventMode"); }
  void leave_events() {
    update();
    call<decltype(fmi3EnterStepMode)>("fmi3EnterStepMode");
  }
  /// Passes the mode events before a time [s] and stops there.
  void go_to(double t) {
    while (now < t) {
      const Step s = step(now, t - now);
      now = s.reached;
      if (!s.event || now >= t) continue;
      enter_events();
      leave_events();
    }
  }
  Clock at;
  double now = 0.0;
};

struct SampleList {
  std::vector<double> time, torque;
};
SampleList samples_of(const Scenario& scenario) {
  SampleList list;
  run_scenario(scenario, {.samples = [&](const std::vector<ControlRecord>& records) {
                 for (const ControlRecord& r : records) {
                   list.time.push_back(r.measured.t);
                   list.torque.push_back(r.applied);
                 }
               }});
  return list;
}

}  // namespace

TEST_CASE("FMI 3.0: an importer that activates the clock of a loop takes the samples of a run") {
  const auto [file, offset, late] =
      GENERATE(table<std::string, std::string, std::string>({{"fig10_sliding_014rad_bare.toml", "0", "0"},
                                                             {"fig10_sliding_014rad_bare.toml", "3e-4", "1"},
                                                             {"fig10_pid_014rad_bare.toml", "0", "0"}}));
  const std::vector<std::string> stated{"run.duration_s=1.2", "run.relative_tolerance=1e-13",
                                        "controller.sample_offset_s=" + offset, "controller.delay_samples=" + late};
  const Exported exported(shipped(file), stated, loop3);
  const SampleList ours = samples_of(exported.scenario);
  const double end = exported.scenario.run.duration;
  Clocked model(*exported.fmu);
  model.begin(end);
  CHECK(model.at.interval == exported.scenario.control->sampling.period);
  CHECK(model.at.shift == exported.scenario.control->sampling.offset);
  CHECK(model.at.qualifier == fmi3IntervalChanged);
  CHECK(model.clock().qualifier == fmi3IntervalUnchanged);
  std::size_t k = 0;
  double error = 0.0, largest = 0.0;
  if (model.at.shift > 0.0) model.leave_events();
  for (double t = model.at.shift; t < end - 1e-9; t = model.at.shift + static_cast<double>(k) * model.at.interval) {
    model.go_to(t);
    if (t > 0.0) model.enter_events();
    CHECK_FALSE(model.is_ticking());
    model.tick();
    CHECK(model.is_ticking());
    REQUIRE(k < ours.time.size());
    CHECK(std::abs(model.real("time") - ours.time[k]) < 1e-12);
    error = std::max(error, std::abs(model.real("controller_torque") - ours.torque[k]));
    largest = std::max(largest, std::abs(ours.torque[k]));
    model.update();
    CHECK_FALSE(model.is_ticking());
    model.call<decltype(fmi3EnterStepMode)>("fmi3EnterStepMode");
    ++k;
  }
  model.go_to(end);
  CHECK(k == ours.time.size());
  CHECK(largest > 1e-3);
  CHECK(error < 1e-6 * largest);

  Instance3 alone(*exported.fmu, true);
  alone.initialize(end);
  for (double t = 0.0; t < end - 1e-9; t += 0.1) alone.step(t, std::min(0.1, end - t));
  CHECK(std::abs(model.real("gear_angle") - alone.real("gear_angle")) < 1e-9);
  CHECK(model.whole("event_count") == alone.whole("event_count"));
}

TEST_CASE("FMI 3.0: samples that an importer passes over are taken all the same") {
  const Exported exported(shipped("fig10_sliding_014rad_bare.toml"), {}, loop3);
  Clocked some(*exported.fmu), none(*exported.fmu);
  some.begin(0.2);
  none.begin(0.2);
  some.leave_events();
  none.leave_events();
  const double h = some.at.interval;
  for (const double ticks : {7.0, 8.0, 31.0}) {
    some.go_to(ticks * h);
    some.enter_events();
    some.tick();
    some.tick();  // of the same instant
    some.leave_events();
  }
  some.go_to(0.2);
  none.go_to(0.2);
  CHECK(std::abs(some.real("gear_angle") - none.real("gear_angle")) < 1e-9);
  CHECK(std::abs(some.real("controller_torque") - none.real("controller_torque")) < 1e-9);
}

TEST_CASE("FMI 3.0: an active clock is part of a kept state") {
  const Exported exported(shipped("fig10_sliding_014rad_bare.toml"), {}, loop3);
  Clocked model(*exported.fmu);
  model.begin(0.2);
  model.tick();
  fmi3FMUState kept = nullptr;
  model.call<decltype(fmi3GetFMUState)>("fmi3GetFMUState", &kept);
  size_t size = 0;
  model.call<decltype(fmi3SerializedFMUStateSize)>("fmi3SerializedFMUStateSize", kept, &size);
  std::vector<fmi3Byte> bytes(size);
  model.call<decltype(fmi3SerializeFMUState)>("fmi3SerializeFMUState", kept, bytes.data(), size);
  model.leave_events();
  model.go_to(0.1);
  const double angle = model.real("gear_angle");
  Clocked other(*exported.fmu);
  fmi3FMUState taken = nullptr;
  other.call<decltype(fmi3DeserializeFMUState)>("fmi3DeserializeFMUState", bytes.data(), size, &taken);
  other.call<decltype(fmi3SetFMUState)>("fmi3SetFMUState", taken);
  CHECK(other.is_ticking());
  other.leave_events();
  other.go_to(0.1);
  CHECK(other.real("gear_angle") == angle);
  model.call<decltype(fmi3FreeFMUState)>("fmi3FreeFMUState", &kept);
  other.call<decltype(fmi3FreeFMUState)>("fmi3FreeFMUState", &taken);
}

TEST_CASE("FMI 3.0: the clock follows the sample time that an importer sets, and ticks at its samples only") {
  const Exported exported(shipped("fig10_sliding_014rad_bare.toml"), {}, loop3);
  Clocked model(*exported.fmu);
  model.set("controller.sample_time_s", 0.002);
  CHECK_THROWS_WITH(model.clock(), "fmi3GetIntervalDecimal must not be called before the initialization mode");
  model.begin(1.0);
  CHECK(model.at.interval == 0.002);
  model.tick();
  CHECK_THROWS_WITH(model.tick(false), "a clock cannot be deactivated");
  model.leave_events();
  CHECK_THROWS_WITH(model.tick(), "fmi3SetClock must not be called in step mode");
  model.go_to(0.001);
  model.enter_events();
  CHECK_THROWS_WITH(model.tick(), "the clock ticks at 0.001 s, the controller samples next at 0.002 s");
  const fmi3ValueReference torque = exported.fmu->reference("controller_torque");
  const fmi3Clock active = true;
  CHECK_THROWS_WITH(model.call<decltype(fmi3SetClock)>("fmi3SetClock", &torque, size_t{1}, &active),
                    "there is no clock with the value reference 15");
  CHECK_THROWS_WITH(model.call<decltype(fmi3SetShiftDecimal)>("fmi3SetShiftDecimal", &torque, size_t{1}, &model.now),
                    "fmi3SetShiftDecimal is not supported");
  model.leave_events();
  model.go_to(0.002);
  model.enter_events();
  model.tick();
}

}  // namespace wormdrive::test::fmi_sample_clock
