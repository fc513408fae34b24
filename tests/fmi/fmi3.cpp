// FMUs of FMI 3.0 in an importer that knows the standard only: the events of `wormdrive run`, found by the importer's
// event mode, and looked at within long steps.
#include "fmi/exported.hpp"
#include "fmi/importer3.hpp"
#include "simulation/run_scenario.hpp"

namespace wormdrive::test::fmi_fmi3 {

namespace {

void look(fmi3InstanceEnvironment self, double t, bool set, bool get, bool, bool can_return, bool* early,
          double* until) {
  auto& importer = *static_cast<Instance3*>(self);
  CHECK_FALSE(set);
  CHECK(get);
  CHECK(importer.real("event_time") == t);
  importer.looked.push_back(t);
  *early = can_return && importer.wanted_end >= t;
  *until = importer.wanted_end;
}

const std::vector<std::string> loop3{"--kind", "loop", "--fmi", "3"};

}  // namespace

TEST_CASE("FMI 3.0: an importer with event mode stops at every event and sees both its sides") {
  const Exported exported(shipped("fig09_switching.toml"), {"run.relative_tolerance=1e-13"}, loop3);
  const Trajectory ours = simulate_scenario(exported.scenario);
  const double end = exported.scenario.run.duration;
  Instance3 model(*exported.fmu, true, true, true);
  model.initialize(end);
  model.update();
  model.call<decltype(fmi3EnterStepMode)>("fmi3EnterStepMode");
  std::size_t k = 0;
  for (double t = 0.0; t < end - 1e-9;) {
    const double before = t;
    const Instance3::Step s = model.step(t, std::min(0.1, end - t));
    t = s.reached;
    CHECK(s.early == s.event);
    CHECK(t > before);
    if (!s.event) continue;
    REQUIRE(k < ours.events.size());
    const Event& event = ours.events[k++];
    CHECK(std::abs(t - event.t) < 1e-9);
    CHECK(std::abs(model.real("gear_angle") - event.after.theta_g) < 1e-8);
    CHECK(model.whole("motion") == sign(event.before.mode.motion));
    CHECK(model.whole("flank") == sign(event.before.mode.flank));
    model.call<decltype(fmi3EnterEventMode)>("fmi3EnterEventMode");
    model.update();
    CHECK(model.whole("motion") == sign(event.after.mode.motion));
    CHECK(model.whole("flank") == sign(event.after.mode.flank));
    model.call<decltype(fmi3EnterStepMode)>("fmi3EnterStepMode");
  }
  CHECK(k == ours.events.size());
  CHECK(k >= 12);
}

TEST_CASE("FMI 3.0: an importer looks at events within a step and may end it after one") {
  const Exported exported(shipped("fig09_switching.toml"), {}, loop3);
  Instance3 whole(*exported.fmu, true, false, true, look), cut(*exported.fmu, true, false, true, look);
  whole.initialize(1.0);
  const Instance3::Step all = whole.step(0.0, 1.0);
  CHECK(all.reached == 1.0);
  CHECK_FALSE(all.early);
  REQUIRE(whole.looked.size() >= 4);
  CHECK(whole.looked.size() == static_cast<std::size_t>(whole.whole("event_count")));
  cut.wanted_end = 0.5 * (whole.looked[1] + whole.looked[2]);
  cut.initialize(1.0);
  const Instance3::Step early = cut.step(0.0, 1.0);
  CHECK(early.early);
  CHECK_FALSE(early.event);
  CHECK(early.reached == cut.wanted_end);
  CHECK(cut.looked.size() == 2);
  cut.wanted_end = -1.0;
  CHECK_FALSE(cut.step(early.reached, 1.0 - early.reached).early);
  CHECK(std::abs(cut.real("gear_angle") - whole.real("gear_angle")) < 1e-9);
}

TEST_CASE("FMI 3.0: model exchange has the rates and indicators of FMI 2.0") {
  const Exported second(shipped("fig09_backlash.toml")), third(shipped("fig09_backlash.toml"), {}, {"--fmi", "3"});
  Instance old(*second.fmu);
  old.call<decltype(fmi2SetupExperiment)>("fmi2SetupExperiment", 0, 0.0, 0.0, 0, 0.0);
  old.call<decltype(fmi2EnterInitializationMode)>("fmi2EnterInitializationMode");
  old.call<decltype(fmi2ExitInitializationMode)>("fmi2ExitInitializationMode");
  fmi2EventInfo info{};
  old.call<decltype(fmi2NewDiscreteStates)>("fmi2NewDiscreteStates", &info);
  old.call<decltype(fmi2EnterContinuousTimeMode)>("fmi2EnterContinuousTimeMode");
  Instance3 model(*third.fmu, false);
  model.initialize(1.0);
  CHECK(model.update());
  model.call<decltype(fmi3EnterContinuousTimeMode)>("fmi3EnterContinuousTimeMode");
  size_t states = 0, indicators = 0;
  model.call<decltype(fmi3GetNumberOfContinuousStates)>("fmi3GetNumberOfContinuousStates", &states);
  model.call<decltype(fmi3GetNumberOfEventIndicators)>("fmi3GetNumberOfEventIndicators", &indicators);
  REQUIRE(states == second.fmu->states);
  REQUIRE(indicators == second.fmu->indicators);
  const std::vector<double> x{0.3, 2.0, 0.004, 0.05};
  std::vector<double> z2(indicators), z3(indicators), rates2(states), rates3(states);
  old.call<decltype(fmi2SetContinuousStates)>("fmi2SetContinuousStates", x.data(), states);
  old.call<decltype(fmi2GetDerivatives)>("fmi2GetDerivatives", rates2.data(), states);
  old.call<decltype(fmi2GetEventIndicators)>("fmi2GetEventIndicators", z2.data(), indicators);
  model.call<decltype(fmi3SetContinuousStates)>("fmi3SetContinuousStates", x.data(), states);
  model.call<decltype(fmi3GetContinuousStateDerivatives)>("fmi3GetContinuousStateDerivatives", rates3.data(), states);
  model.call<decltype(fmi3GetEventIndicators)>("fmi3GetEventIndicators", z3.data(), indicators);
  CHECK(rates2 == rates3);
  CHECK(z2 == z3);
}

TEST_CASE("FMI 3.0: calls out of order are refused") {
  const Exported exported(shipped("fig09_switching.toml"), {}, loop3);
  Instance3 model(*exported.fmu, true);
  CHECK_THROWS_WITH(model.step(0.0, 0.1), "fmi3DoStep must not be called before the initialization mode");
  model.initialize(1.0);
  CHECK_THROWS_WITH(model.call<decltype(fmi3EnterEventMode)>("fmi3EnterEventMode"),
                    "the instance was made without event mode");
  CHECK_THROWS_WITH(model.call<decltype(fmi3EnterContinuousTimeMode)>("fmi3EnterContinuousTimeMode"),
                    "fmi3EnterContinuousTimeMode must not be called in step mode");
  CHECK_THROWS_WITH(model.call<decltype(fmi3EvaluateDiscreteStates)>("fmi3EvaluateDiscreteStates"),
                    "fmi3EvaluateDiscreteStates is not supported");
  CHECK_THROWS_WITH(Instance3(*exported.fmu, false), "this FMU is one for co-simulation");
  CHECK(model.step(0.0, 1.0).reached == 1.0);
}

TEST_CASE("the description of an FMU keeps to the schema of FMI 3.0", "[reference]") {
  const std::string schemas = WORMDRIVE_REFERENCE_DATA "/../fmi/", xmllint = "/usr/bin/xmllint";
  if (!std::filesystem::exists(schemas + "fmi3ModelDescription.xsd")) {
    WARN("skipped: reference data not found");
    return;
  }
  for (const auto& [file, kind] : {std::pair<std::string, std::string>{"fig09_switching", "plant"},
                                   {"fig09_switching", "loop"},
                                   {"fig09_backlash", "plant"},
                                   {"fig10_sliding_014rad_bare", "loop"},
                                   {"fig10_pid_014rad_bare", "plant"},
                                   {"excitation_rich", "loop"},
                                   {"measured_servo_axis", "plant"}})
    for (const std::string version : {"2", "3"}) {
      const Exported exported(shipped(file + ".toml"), {}, {"--kind", kind, "--fmi", version});
      const auto keeps = [&, &file = file, &kind = kind](const std::string& schema, const std::string& xml) {
        const Outcome outcome =
            Process({xmllint, "--noout", "--schema", schemas + schema, xml}, exported.folder.path()).wait();
        INFO(file << ' ' << kind << ' ' << outcome.err);
        CHECK(outcome.exit == 0);
      };
      keeps("fmi" + version + "ModelDescription.xsd", "modelDescription.xml");
      if (version == "3") keeps("fmi3TerminalsAndIcons.xsd", "terminalsAndIcons/terminalsAndIcons.xml");
    }
}

}  // namespace wormdrive::test::fmi_fmi3
