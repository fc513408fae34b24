#include <algorithm>
#include <cmath>
#include <iostream>

#include "catch.hpp"
#include "diagnosis/candidates/coordinates.hpp"
#include "diagnosis/diagnose.hpp"
#include "numbers.hpp"
#include "recovery/tables.hpp"

// Benches that are drawn with all that they are: ratio, friction, size, encoder, rate and duration.

namespace recovery::any_bench {

namespace {

/// The drawn cases that take a diagnosis a second or two.
std::vector<Case> short_ones(Plan plan) {
  plan.any_bench = true;
  std::vector<Case> cases = draw(plan);
  std::erase_if(cases, [](const Case& c) { return c.duration / c.period > 8000.0; });
  return cases;
}

std::vector<Outcome> outcomes(const std::vector<Case>& cases) {
  const auto all = run(
      cases,
      [](const auto& sheet, const auto& recordings) { return wormdrive::diagnose(sheet, recordings, {.threads = 1}); },
      2);
  for (const Outcome& o : all) std::cout << line(o) << "\n";
  return all;
}

}  // namespace

TEST_CASE("where nothing is hidden nothing is named, on benches of any size, rate and encoder", "[recovery][slow]") {
  const auto found =
      outcomes(short_ones({.kind = Kind::nothing, .conditions = conditions("realistic"), .cases = 40, .seed = 101}));
  REQUIRE(found.size() > 10);
  CHECK(count(found, Score::exact) == static_cast<long>(found.size()));
  const auto alarms = std::count_if(found.begin(), found.end(), [](const Outcome& o) { return o.flagged; });
  CHECK(alarms <= 1);
}

TEST_CASE("what rounding to counts looks like is no torque noise", "[recovery]") {
  Plan plan{.kind = Kind::nothing, .conditions = conditions("realistic"), .cases = 3, .seed = 301};
  plan.any_bench = true;
  const Case drawn = draw(plan).back();  // 7862 counts per turn, 2.3 of them in a sample
  const Bench bench = record(drawn);
  const auto d = wormdrive::diagnose(data_sheet(drawn), {bench.recording}, {.threads = 2});
  INFO(d.sentence);
  CHECK(d.verdict == wormdrive::Verdict::adequate);
  CHECK(d.noise_torque < 10.0 * bench.drive.noise.white);
}

TEST_CASE("a diagnosis hangs on no unit of torque", "[recovery]") {
  constexpr double times = 64.0;  // a power of two: no digit changes
  Case drawn = short_ones({.kind = Kind::single,
                           .conditions = conditions("realistic"),
                           .sizes = {truth::Size::large},
                           .effects = {"worm_viscous"},
                           .cases = 12,
                           .seed = 7})
                   .front();
  const Bench bench = record(drawn);
  const wormdrive::Scenario sheet = data_sheet(drawn);
  wormdrive::Scenario scaled = sheet;
  auto& mesh = std::get<wormdrive::MeshParameters<double>>(scaled.mesh);
  mesh.Jw *= times;
  mesh.Jg *= times;
  *std::get<wormdrive::GravityArm>(scaled.load).mass *= times;
  *scaled.tolerance->torque_offset *= times;
  wormdrive::Recording recording = bench.recording;
  for (double& torque : recording.motor_torque) torque *= times;

  const wormdrive::Diagnosis one = wormdrive::diagnose(sheet, {bench.recording}, {.threads = 2}),
                             other = wormdrive::diagnose(scaled, {recording}, {.threads = 2});
  CAPTURE(one.sentence, other.sentence);
  CHECK(one.verdict == other.verdict);
  REQUIRE(one.causes.size() == other.causes.size());
  REQUIRE(one.ranking.size() == other.ranking.size());
  for (std::size_t k = 0; k < one.ranking.size(); ++k) {
    CAPTURE(one.ranking[k].effect.effect, one.ranking[k].delta_bic, other.ranking[k].delta_bic);
    CHECK(one.ranking[k].effect.effect == other.ranking[k].effect.effect);
    CHECK(std::abs(one.ranking[k].delta_bic - other.ranking[k].delta_bic) <= 1e-3);
  }
  CHECK(wormdrive::test::close(other.noise_torque, times * one.noise_torque, 1e-6));
  CHECK(wormdrive::test::close(other.noise_angle, one.noise_angle, 1e-6));
  for (std::size_t k = 0; k < one.prediction.size(); ++k)
    CHECK(wormdrive::test::close(other.prediction[k].after, one.prediction[k].after, 1e-6));
}

}  // namespace recovery::any_bench
