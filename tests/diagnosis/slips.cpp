#include <cmath>
#include <numbers>
#include <random>
#include <string>

#include "catch.hpp"
#include "core/loads/gravity_arm.hpp"
#include "description/diagnostics.hpp"
#include "description/number_text.hpp"
#include "diagnosis/data/read_recording.hpp"
#include "diagnosis/diagnose.hpp"
#include "recovery/campaign.hpp"
#include "simulation/load_scenario.hpp"

// Slips that people make in what they state: the drive is the same, its sheet is wrong by a factor or by any angle.

namespace wormdrive::test::diagnosis_slips {

namespace {

struct Bench {
  Scenario sheet = recovery::data_sheet(recovery::conditions("ideal"));
  Recording recording;

  explicit Bench(std::uint64_t seed)
      : recording(recovery::record({recovery::Kind::nothing, recovery::conditions("ideal"), seed, {}, 12.0, 2e-3})
                      .recording) {}

  MeshParameters<double>& mesh() { return std::get<MeshParameters<double>>(sheet.mesh); }
  GravityArm& arm() { return std::get<GravityArm>(sheet.load); }
};

/// The first number of the only cause that is named.
double only_cause(const Bench& bench, const std::string& effect) {
  const Diagnosis d = diagnose(bench.sheet, {bench.recording}, {.threads = 2});
  std::string ranking;
  for (const RankedCandidate& c : d.ranking) ranking += c.effect.effect + " " + c.outcome + "; ";
  CAPTURE(d.sentence, ranking, d.remarks);
  REQUIRE(d.causes.size() == 1);
  CHECK(d.causes[0].effect == effect);
  return d.causes[0].parameters[0].value;
}

}  // namespace

TEST_CASE("the inertia of a load that was forgotten is named, however large it is beside the gear's", "[slow]") {
  Bench bench(31);
  const double forgotten = bench.arm().inertia();
  REQUIRE(forgotten > 3.0 * bench.mesh().Jg);
  bench.arm().amplitude = bench.arm().torque_amplitude();
  bench.arm().mass = bench.arm().arm = {};
  CHECK(std::abs(only_cause(bench, "gear_inertia") / forgotten - 1.0) < 0.03);
}

TEST_CASE(
    "an inertia far from what is stated is named, though gain, load and worm inertia give way for it within theirs") {
  recovery::Plan plan{.conditions = recovery::conditions("realistic"), .cases = 22, .seed = 4201};
  plan.any_bench = true;
  recovery::Case drawn = recovery::draw(plan)[21];  // ratio 11: without the inertia time scale does nearly as well
  drawn.duration = 4.0;
  const Recording recording = recovery::record(drawn).recording;
  for (const double factor : {3.0, 6.0, 10.0}) {
    Scenario sheet = recovery::data_sheet(drawn);
    auto& mesh = std::get<MeshParameters<double>>(sheet.mesh);
    auto& arm = std::get<GravityArm>(sheet.load);
    const double all = mesh.Jg + arm.inertia();
    arm.amplitude = arm.torque_amplitude();
    arm.mass = arm.arm = {};
    mesh.Jg = all / factor;
    const Diagnosis d = diagnose(sheet, {recording}, {.threads = 2});
    CAPTURE(factor, d.sentence);
    REQUIRE(d.causes.size() == 1);
    CHECK(d.causes[0].effect == "gear_inertia");
    CHECK(std::abs(d.causes[0].parameters[0].value / (all - mesh.Jg) - 1.0) < 0.05);
  }
}

TEST_CASE("an arm that stands at another angle than stated is named, wherever it stands", "[slow]") {
  Bench bench(32);
  std::mt19937_64 generator(32);
  const double off = std::uniform_real_distribution<double>(1.0, std::numbers::pi)(generator);
  bench.arm().offset += off;
  CHECK(std::abs(std::remainder(only_cause(bench, "load_angle") + off, 2.0 * std::numbers::pi)) < 0.01);
}

TEST_CASE("a motor current that is read as a torque is named as a gain", "[slow]") {
  Bench bench(33);
  const double torque_constant = 0.13;
  for (double& torque : bench.recording.motor_torque) torque /= torque_constant;
  CHECK(std::abs(only_cause(bench, "torque_gain") + 1.0 - torque_constant) < 0.01);
}

TEST_CASE("friction that is stated as zero is named", "[slow]") {
  Bench bench(34);
  const double friction = bench.mesh().mu;
  bench.mesh().mu = 0.0;
  CHECK(std::abs(only_cause(bench, "mesh_friction") / friction - 1.0) < 0.02);
}

namespace {

/// Why a recording is rejected; empty if it is read.
std::string rejection(const truth::Recording& recorded, const Scenario& sheet, std::uint64_t seed) {
  try {
    recovery::as_read(recorded, sheet, seed);
    return {};
  } catch (const InputFault& fault) {
    return fault.what();
  }
}

truth::Recording turned(truth::Recording recorded, std::vector<double> truth::Recording::*column) {
  for (double& x : recorded.*column) x = -x;
  return recorded;
}

}  // namespace

TEST_CASE("a wrong sign and a load that nobody states are told on benches of any size before anything is diagnosed") {
  recovery::Plan plan{
      .kind = recovery::Kind::nothing, .conditions = recovery::conditions("realistic"), .cases = 24, .seed = 2002};
  plan.any_bench = true;
  int benches = 0;
  for (recovery::Case drawn : recovery::draw(plan)) {
    if (drawn.duration / drawn.period > 8000.0) continue;
    ++benches;
    CAPTURE(drawn.seed);
    Scenario sheet = recovery::data_sheet(drawn);
    const truth::Recording recorded = recovery::followed(drawn).recorded;
    const auto said = [&](const truth::Recording& r) { return rejection(r, sheet, drawn.seed); };
    CHECK(said(recorded).empty());
    CHECK(said(turned(recorded, &truth::Recording::motor_torque))
              .find("motor_torque_Nm fits the drive with the opposite sign, not as it stands") != std::string::npos);
    CHECK(said(turned(recorded, &truth::Recording::gear_angle))
              .find("gear_angle_rad fits the drive with the opposite sign, not as it stands") != std::string::npos);
    sheet.load = Signal{};
    CHECK(said(recorded).find(": state the [load]") != std::string::npos);

    // without a load none is missed
    drawn.stated.sheet.geometry.mass = drawn.stated.geometry.mass = 1e-9;
    CHECK(said(recovery::followed(drawn).recorded).empty());
  }
  REQUIRE(benches >= 5);
}

TEST_CASE("a load that nobody states is missed before anything is diagnosed") {
  const std::string folder = WORMDRIVE_SCENARIOS;
  Scenario scenario = load_scenario(folder + "/example_bench.toml", {}, Purpose::look);
  CHECK_NOTHROW(read_recording(folder + "/example_bench.csv", scenario));
  const double torque = std::get<GravityArm>(scenario.load).torque_amplitude();
  scenario.load = Signal{};
  try {
    read_recording(folder + "/example_bench.csv", scenario);
    FAIL("it was read");
  } catch (const InputFault& fault) {
    const std::string said = fault.what();
    CAPTURE(said, torque);
    CHECK(said.find("motor_torque_Nm does not fit a drive without a load") != std::string::npos);
    CHECK(said.find(": state the [load]") != std::string::npos);
    const auto about = said.find("about ");
    REQUIRE(about != std::string::npos);
    CHECK(std::abs(number_in(said.substr(about + 6, said.find(' ', about + 6) - about - 6)).value() / torque - 1.0) <
          0.1);
  }
}

}  // namespace wormdrive::test::diagnosis_slips
