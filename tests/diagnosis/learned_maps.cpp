#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "diagnosis/answers.hpp"
#include "diagnosis/recordings.hpp"
#include "recovery/campaign.hpp"
#include "simulation/run_scenario.hpp"

// What no effect explains becomes a map of the torque, which predicts data that it has not seen and claims no cause.

namespace wormdrive::test::diagnosis_learned_maps {

namespace {

const TorqueMap<double>* map_in(const Diagnosis& d) {
  const auto& map = std::get<std::optional<TorqueMap<double>>>(d.extended.effects.list);
  return map ? &*map : nullptr;
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
  CHECK(d.sentence.find("claims no cause; it is in the extended scenario as torque_map") != std::string::npos);
  CAPTURE(map->table.points(), map->table.values());
  double square = 0.0, size = 0.0;
  for (double angle = map->table.points().front(); angle < map->table.points().back(); angle += 0.05) {
    square += std::pow(map->table(angle) - bumps(angle), 2);
    size += std::pow(bumps(angle), 2);
  }
  CHECK(square < 0.09 * size);
}

TEST_CASE("a fan on the gear, which no effect is, comes back as a map of its shaft, and what it is in runs", "[slow]") {
  recovery::Case drawn{recovery::Kind::outside, recovery::conditions("ideal"), 5, {}, 12.0, 2e-3};
  const auto hidden = truth::outside();
  const auto fan = std::find_if(hidden.begin(), hidden.end(), [](const auto& s) { return s.effect == "fan"; });
  drawn.hidden = {{&*fan, truth::Size::large, fan->large}};
  const Scenario sheet = recovery::data_sheet(drawn);
  const Diagnosis d = diagnose(sheet, {recovery::record(drawn).recording}, {.threads = 2});
  CAPTURE(d.sentence);
  REQUIRE(d.verdict == Verdict::unexplained);
  const TorqueMap<double>* const map = map_in(d);
  REQUIRE(map);
  CHECK(map->over == MapAxis::worm_speed);
  CHECK(map->shaft == MapShaft::gear);
  CHECK(map->table(150.0) < -0.5 * fan->large * std::pow(150.0 / 60.0, 2));
  CHECK(map->table(-150.0) > 0.5 * fan->large * std::pow(150.0 / 60.0, 2));
  CHECK(error_ahead(d).after < 0.7 * error_ahead(d).before);
  Scenario runs = d.extended;
  runs.motor = {{Sinusoid{.amplitude = 0.05, .frequency = 1.0}}};
  runs.control.reset();
  runs.run.duration = 2.0;
  CHECK(simulate_scenario(runs).events.size() > 2);
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

}  // namespace wormdrive::test::diagnosis_learned_maps
