#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "diagnosis/answers.hpp"
#include "diagnosis/recordings.hpp"
#include "recovery/campaign.hpp"
#include "simulation/run_scenario.hpp"

// What no effect explains is learned, as terms that predict data that they have not seen and claim no cause.

namespace wormdrive::test::diagnosis_learned_terms {

namespace {

template <class Effect>
const Effect* learned(const Diagnosis& d) {
  const auto& effect = std::get<std::optional<Effect>>(d.extended.effects.list);
  return effect ? &*effect : nullptr;
}
const TorqueMap<double>* map_in(const Diagnosis& d) { return learned<TorqueMap<double>>(d); }

/// What is said and learned of a drive with an effect outside the catalogue, and that drive.
struct Outside {
  Diagnosis found;
  truth::Drive drive;
};

Outside with_hidden(const std::string& effect, double duration, double period, std::uint64_t seed = 5) {
  recovery::Case drawn{recovery::Kind::outside, recovery::conditions("ideal"), seed, {}, duration, period};
  const truth::Secret& secret = truth::secret(effect);
  drawn.hidden = {{&secret, truth::Size::large, secret.large}};
  const recovery::Bench bench = recovery::record(drawn);
  return {diagnose(recovery::data_sheet(drawn), {bench.recording}, {.threads = 2}), bench.drive};
}

void check_it_runs(Scenario runs) {
  runs.motor = {{Sinusoid{.amplitude = 0.05, .frequency = 1.0}}};
  runs.control.reset();
  runs.run.duration = 2.0;
  CHECK(simulate_scenario(runs).events.size() > 2);
}

}  // namespace

TEST_CASE("a torque over the angle that no effect has comes back as a map", "[slow]") {
  Scenario drive = nominal_arm();
  const CubicTable bumps({-2.4, -1.6, -1.0, -0.4, 0.2, 0.8, 1.4, 2.4},
                         {0, 0.003, -0.002, -0.006, 0.001, 0.005, -0.002, 0});
  std::get<std::optional<TorqueMap<double>>>(drive.effects.list) = {MapAxis::gear_angle, 1.0, bumps};
  const Diagnosis d = diagnose(nominal_arm(), {record(drive, {.duration = 12.0})}, {.threads = 2});
  CAPTURE(d.sentence);
  REQUIRE(d.causes.empty());
  const TorqueMap<double>* const map = map_in(d);
  REQUIRE(map);
  CHECK(map->over == MapAxis::gear_angle);
  CHECK(map->shaft == MapShaft::worm);
  CHECK(error_ahead(d).after < 0.3 * error_ahead(d).before);
  CHECK(d.sentence.find("One term was learned from these data: a torque on the worm over the gear angle. It claims no "
                        "cause and is in the extended scenario as torque_map. With it") != std::string::npos);
  CAPTURE(map->table.points(), map->table.values());
  double square = 0.0, size = 0.0;
  for (double angle = map->table.points().front(); angle < map->table.points().back(); angle += 0.05) {
    square += std::pow(map->table(angle) - bumps(angle), 2);
    size += std::pow(bumps(angle), 2);
  }
  CHECK(square < 0.09 * size);
}

TEST_CASE("a fan on the gear, which no effect is, comes back as a map of its shaft, and what it is in runs", "[slow]") {
  const auto [d, drive] = with_hidden("fan", 12.0, 2e-3);
  CAPTURE(d.sentence);
  REQUIRE(d.verdict == Verdict::unexplained);
  const TorqueMap<double>* const map = map_in(d);
  REQUIRE(map);
  CHECK(map->over == MapAxis::worm_speed);
  CHECK(map->shaft == MapShaft::gear);
  CHECK(map->table(150.0) < -0.5 * drive.bearings.fan * std::pow(150.0 / 60.0, 2));
  CHECK(map->table(-150.0) > 0.5 * drive.bearings.fan * std::pow(150.0 / 60.0, 2));
  CHECK(error_ahead(d).after < 0.7 * error_ahead(d).before);
  check_it_runs(d.extended);
}

TEST_CASE("a vibration, which could pass for noise of the torque, comes back with its size and frequency", "[slow]") {
  const auto [d, drive] = with_hidden("vibration", 8.0, 1e-3);
  CAPTURE(d.sentence);
  REQUIRE(d.verdict == Verdict::unexplained);
  const auto* const shakes = learned<Vibration<double>>(d);
  REQUIRE(shakes);
  CHECK(close(std::abs(shakes->amplitude), drive.actuator.vibration, 0.05));
  CHECK(std::abs(shakes->frequency - drive.actuator.vibration_frequency) < 0.01);
  CHECK(error_ahead(d).after < 0.3 * error_ahead(d).before);
  CHECK(d.sentence.find(" Hz. It claims no cause and is in the extended scenario as vibration.") != std::string::npos);
  CHECK(d.experiment_reason.starts_with("record once more with everything switched off that runs beside the drive"));
  check_it_runs(d.extended);
}

TEST_CASE("a rough place of the gear comes back as friction over its angle", "[slow]") {
  const auto [d, drive] = with_hidden("friction_spot", 16.0, 2e-3, 8);
  CAPTURE(d.sentence);
  REQUIRE(d.verdict == Verdict::unexplained);
  const auto* const map = learned<FrictionMap<double>>(d);
  REQUIRE(map);
  REQUIRE(map->over == FrictionAxis::gear_angle);
  const double there = map->table(drive.friction.spot_angle), beside = map->table(drive.friction.spot_angle - 1.0);
  CHECK(there - beside > 0.5 * drive.friction.spot);
  CHECK(error_ahead(d).after < 0.4 * error_ahead(d).before);
  CHECK_FALSE(d.experiment_reason.empty());
  check_it_runs(d.extended);
}

TEST_CASE("a mass that comes off on the way comes back as a load over the time", "[slow]") {
  const auto [d, drive] = with_hidden("mass_lost", 20.0, 2e-3);
  CAPTURE(d.sentence);
  REQUIRE(d.verdict == Verdict::unexplained);
  const auto* const map = learned<LoadMap<double>>(d);
  REQUIRE(map);
  REQUIRE(map->over == LoadAxis::time);
  CHECK(std::abs(map->table(19.0) - map->table(1.0) + drive.load.lost) < 0.2 * drive.load.lost);
  CHECK(error_ahead(d).after < 0.4 * error_ahead(d).before);
  check_it_runs(d.extended);
}

TEST_CASE("a scenario that states a map is diagnosed with it", "[slow]") {
  Scenario drive = nominal_arm();
  const CubicTable falls({-300, -100, 100, 300}, {4e-3, 4e-3, -4e-3, -4e-3});
  std::get<std::optional<TorqueMap<double>>>(drive.effects.list) = {MapAxis::worm_speed, 1.0, falls};
  const Diagnosis d = diagnose(drive, {record(drive, {.duration = 6.0})}, {.threads = 2});
  CAPTURE(d.sentence);
  CHECK(d.verdict == Verdict::adequate);
  REQUIRE(map_in(d));
  CHECK(map_in(d)->table == falls);
}

}  // namespace wormdrive::test::diagnosis_learned_terms
