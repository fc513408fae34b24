#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "description/diagnostics.hpp"
#include "diagnosis/candidates/tolerances.hpp"
#include "diagnosis/experiment/experiment.hpp"
#include "diagnosis/recordings.hpp"
#include "recovery/campaign.hpp"
#include "simulation/load_scenario.hpp"
#include "support.hpp"

// What a diagnosis proposes to record next: within the limits of the drive, whatever its size.

namespace wormdrive::test::diagnosis_experiments {

namespace {

/// A drive with a slow motion that tells little, and the question that it leaves: friction of the teeth or of the worm?
struct Bench {
  Scenario sheet;
  std::vector<PreparedRecording> recordings;
  Question question;

  Experiment experiment(const std::optional<ExperimentLimits>& limits = {}) {
    question.stated.limits = limits;
    return best_experiment(question, allowed_range(question.stated, recordings, question.sizes.load_turns), 2);
  }
};

Bench bench(const truth::Drive& drive, std::uint64_t seed) {
  Bench b;
  b.sheet = recovery::data_sheet(recovery::conditions("realistic"), drive.sheet);
  b.recordings.push_back(prepared(recovery::follow(drive, truth::slow_course(0.3, 0.2, 8.0), b.sheet, seed), 0));
  const Magnitudes sizes = magnitudes(b.sheet, b.recordings);
  const std::vector<Coordinate> toleranced = toleranced_coordinates(b.sheet, sizes, {});
  std::vector<Candidate> contenders;
  for (const Candidate& c : candidates(b.sheet.effects, sizes, toleranced))
    if (c.effect == "mesh_friction" || c.effect == "worm_coulomb") contenders.push_back(c);
  REQUIRE(contenders.size() == 2);
  const auto is_friction = [](const Candidate& c) { return c.effect == "mesh_friction"; };
  std::stable_partition(contenders.begin(), contenders.end(), is_friction);
  b.question = {.stated = b.sheet,
                .found = b.sheet,
                .contenders = contenders,
                .size = 0.5 * drive.sheet.friction,
                .toleranced = toleranced,
                .sizes = sizes,
                .noise_torque = drive.noise.white,
                .counts = drive.sensor.counts};
  return b;
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double x : values) most = std::max(most, std::abs(x));
  return most;
}

}  // namespace

TEST_CASE("an experiment asks no more of a drive than it may, whatever its size", "[cases]") {
  truth::Generator generator(11);
  int found = 0;
  for (int k = 0; k < 6; ++k) {
    const truth::Drive drive = truth::any_drive(generator);
    Bench b = bench(drive, generator());
    const Experiment free = b.experiment();
    REQUIRE(free.scenario);
    const Recording went = simulated(*free.scenario);
    const double torque = largest(went.motor_torque), angle = largest(went.gear_angle);
    CAPTURE(k, torque, angle, free.reason);
    const ExperimentLimits limits{.torque = 0.9 * torque, .speed = 0.3, .low = -0.2 * angle, .high = 0.5 * angle};
    const Experiment within = b.experiment(limits);
    if (!within.scenario) continue;
    ++found;
    const Recording asked = simulated(*within.scenario);
    INFO(within.reason);
    constexpr double a_little = 1.03;  // noise, and what a loop overshoots
    CHECK(largest(asked.motor_torque) <= a_little * *limits.torque);
    const auto [low, high] = std::minmax_element(asked.gear_angle.begin(), asked.gear_angle.end());
    const double spare = 0.03 * (*limits.high - *limits.low);
    CHECK(*low >= *limits.low - spare);
    CHECK(*high <= *limits.high + spare);
    for (double t = 0.0; t < within.scenario->run.duration; t += 0.01)
      CHECK(std::abs(within.scenario->control->reference.at(t).speed) <= a_little * *limits.speed);
  }
  CHECK(found >= 2);
}

TEST_CASE("limits that leave no motion leave no experiment") {
  Bench b = bench({}, 3);
  const Experiment none = b.experiment(ExperimentLimits{.torque = 1e-3, .speed = 0.3, .low = -0.2, .high = 0.2});
  CHECK_FALSE(none.scenario);
  CHECK(none.reason == "no motion that the drive may be asked for tells them apart");
  CHECK_FALSE(b.experiment(ExperimentLimits{.low = 3.0, .high = {}})
                  .scenario);  // above all that the recordings and the load tell
}

TEST_CASE("stops leave an experiment the way between them") {
  Scenario arm = nominal_arm();
  arm.effects.for_each([](auto& effect) {
    if constexpr (std::is_same_v<std::decay_t<decltype(effect)>, std::optional<HardStops<double>>>)
      effect = HardStops<double>{-0.5, 1.5};
  });
  const PreparedRecording slow = prepared(
      record(nominal_arm(), {.duration = 4.0, .motion = {SinusoidReference{.amplitude = 0.3, .frequency = 0.3}}}), 0);
  const MotionLimits hard = allowed_range(arm, {slow}, true);
  CHECK(hard.low == -0.4);
  CHECK(hard.high == 1.4);
  Scenario soft = nominal_arm();
  soft.load = LoadSum{{std::get<GravityArm>(soft.load), EndStops{.low = -0.5, .high = 1.5, .stiffness = 20.0}}};
  const MotionLimits between = allowed_range(soft, {slow}, true);
  CHECK(between.low == -0.4);
  CHECK(between.high == 1.4);
  soft.limits = ExperimentLimits{.low = 0.0, .high = 0.2};
  CHECK(allowed_range(soft, {slow}, true).high == 0.2);
  // nothing is stated: what the recordings reached, and more of it
  const MotionLimits free = allowed_range(nominal_arm(), {slow}, false);
  CHECK(std::abs(free.high - 0.3) < 0.01);
  const double asked = 2.0 * std::numbers::pi * 0.3 * 0.3;
  CHECK(free.speed > 5.0 * asked);
  CHECK(free.speed < 6.0 * asked);  // the loop takes up the motion
}

}  // namespace wormdrive::test::diagnosis_experiments
