#include <cmath>
#include <numeric>

#include "catch.hpp"
#include "diagnosis/fitting/evaluation.hpp"
#include "diagnosis/recordings.hpp"
#include "events/short_step_solver.hpp"
#include "support.hpp"

// The predictor and the solver beneath it, each against something that it does not know.

namespace wormdrive::test::diagnosis_predictor {

namespace {

Evaluation evaluation_of(const Scenario& scenario, const Recording& recording) {
  return {scenario, InnovationLayout({prepared(recording, 0)}), 1};
}

/// Correlation of a series with itself some samples later.
double correlation(std::span<const double> e, std::size_t lag) {
  double with = 0.0, own = 0.0;
  for (std::size_t k = 200; k + lag < e.size(); ++k) {
    with += e[k] * e[k + lag];
    own += e[k] * e[k];
  }
  return with / own;
}

}  // namespace

TEST_CASE("short steps follow a rigid drive under held torques as power series do") {
  Samples held;
  for (int k = 0; k < 1000; ++k) {
    held.times.push_back(0.001 * k);
    held.values.push_back(0.06 * std::sin(0.0131 * k) + 0.01 * std::sin(1.3 * k));
  }
  const auto d = drive(table1(), fig9_load(), {{held}},
                       effects(WormCoulomb<double>{1e-3}, Stribeck<double>{0.05, 0.1, 1}, Cogging<double>{1e-3, 2, 0.3},
                               PositionFriction<double>{0.05, 0.4}));
  const Timetable timetable(0, 1, 1e-3);
  const auto exact = run(d, timetable, {}, tight(taylor, 1e-12));
  auto follower = d;
  ShortStepSolver<decltype(follower)> solver(follower, 1e-3);
  std::vector<Mode> modes{{}};
  const auto end = simulate(follower, solver, timetable, {}, [&](const auto&, const auto& now) {
    if (!(now.mode == modes.back())) modes.push_back(now.mode);
  });
  REQUIRE(std::abs(end.x[0] - exact.end.x[0]) <= 1e-6);
  REQUIRE(std::abs(end.x[1] - exact.end.x[1]) <= 1e-5);
  REQUIRE(exact.events.size() > 5);
}

TEST_CASE("without noise the innovations of the right model vanish") {
  RecordingConditions exact{.duration = 4, .period = 1e-3, .white_torque = 0, .counts = 0, .angle_noise = 0};
  Scenario arm = nominal_arm();
  std::get<std::optional<WormCoulomb<double>>>(arm.effects.list) = WormCoulomb<double>{2e-3};
  const Recording recording = record(arm, exact);
  const Evaluation evaluation = evaluation_of(arm, recording);
  const auto right = evaluation.innovations(arm.effects, {0.1, 0.0});
  const auto wrong = evaluation.innovations({}, {0.1, 0.0});
  REQUIRE(right);
  REQUIRE(wrong);
  Deviation small, large;
  for (std::size_t k = 500; k < recording.samples(); ++k) {
    small.add((*right)[k]);
    large.add((*wrong)[k]);
  }
  REQUIRE(small <= 2e-9);
  REQUIRE(large.size > 1e-6);
}

TEST_CASE("the innovations of the right model are white, those of a wrong one are not") {
  Scenario arm = nominal_arm();
  set_field(arm.effects, {"worm_coulomb", "torque", 4e-3});
  const Recording recording = record(arm, {.period = 1e-3});
  const Evaluation evaluation = evaluation_of(arm, recording);
  const auto right = evaluation.innovations(arm.effects, {0.012, 0.0});
  const auto wrong = evaluation.innovations({}, {0.012, 0.0});
  REQUIRE(right);
  REQUIRE(wrong);
  for (const std::size_t lag : {1U, 2U, 5U, 20U, 100U}) {
    CAPTURE(lag);
    CHECK(std::abs(correlation(*right, lag)) < 0.04);  // 1/sqrt(n) is 0.0065
  }
  CHECK(correlation(*wrong, 5) > 0.1);
}

TEST_CASE("a late encoder and a late command are the same to the predictor") {
  const Recording recording = record(nominal_arm(), {.duration = 3});
  const Evaluation evaluation = evaluation_of(nominal_arm(), recording);
  Effects<double> sensor, actuator;
  set_field(sensor, {"encoder_delay", "delay", 1.7e-3});
  set_field(actuator, {"actuator_delay", "delay", 1.7e-3});
  REQUIRE(*evaluation.innovations(sensor, {}) == *evaluation.innovations(actuator, {}));
}

TEST_CASE("a model that runs away has no innovations, and takes no time to tell") {
  const Recording recording = record(nominal_arm(), {.duration = 4});
  const Evaluation evaluation = evaluation_of(nominal_arm(), recording);
  Effects<double> pushes;
  set_field(pushes, {"worm_viscous", "coefficient", -1e-2});  // faster and faster, with ever shorter steps
  REQUIRE_FALSE(evaluation.innovations(pushes, {0.012, 0.0}));
}

TEST_CASE("a prediction ahead from the state of a sample starts where the recording was") {
  RecordingConditions exact{.duration = 4, .period = 1e-3, .white_torque = 0, .counts = 0, .angle_noise = 0};
  Scenario arm = nominal_arm();
  set_field(arm.effects, {"actuator_delay", "delay", 2.5e-3});  // what is on the way at the start counts as well
  const Recording recording = record(arm, exact);
  const Evaluation evaluation = evaluation_of(arm, recording);
  std::vector<FilteredStates> states;
  REQUIRE(evaluation.innovations(arm.effects, {0.1, 0.0}, {}, &states));
  const std::vector<std::size_t> begins{1500, 2600};
  const auto rows = evaluation.run_on(arm.effects, {0.1, 0.0}, 0, states[0], begins, 250);
  for (std::size_t q = 0; q < begins.size(); ++q) {
    REQUIRE(rows[q].size() == 250);
    Deviation worst;
    for (std::size_t k = 0; k < 250; ++k) worst.add(rows[q][k] - recording.gear_angle[begins[q] + 1 + k]);
    REQUIRE(worst <= 2e-5);
  }
}

TEST_CASE("a model that meets the innovations it had runs through the recording again") {
  Scenario arm = nominal_arm();
  const Recording recording = record(arm, {.duration = 4, .period = 1e-3});
  const Evaluation evaluation = evaluation_of(arm, recording);
  const ProcessNoise noise{0.012, 0.003};
  std::vector<FilteredStates> states;
  const auto e = evaluation.innovations(arm.effects, noise, {}, &states);
  REQUIRE(e);
  const std::vector<std::size_t> begins{700, 2600};
  const auto rows = evaluation.run_on(arm.effects, noise, 0, states[0], begins, 250, *e);
  Deviation worst;
  for (std::size_t q = 0; q < begins.size(); ++q)
    for (std::size_t k = 0; k < 250; ++k) worst.add(rows[q][k] - recording.gear_angle[begins[q] + 1 + k]);
  REQUIRE(worst <= 1e-12);
}

}  // namespace wormdrive::test::diagnosis_predictor
