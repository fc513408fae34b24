#include "diagnosis/changes.hpp"

#include <cmath>
#include <random>

#include <fmt/format.h>

#include "catch.hpp"
#include "diagnosis/candidates/coordinates.hpp"
#include "diagnosis/diagnose_files.hpp"
#include "diagnosis/sheet.hpp"
#include "recovery/truth/hidden.hpp"
#include "support.hpp"

// Two sets of data of one drive: what lies between them is told, and nothing that was wrong all along.

namespace wormdrive::test::diagnosis_changes {
namespace {

constexpr double duration = 8.0, period = 2e-3;  // [s]

/// A recording of the bench with effects hidden in it, by the generator that shares no code with the program.
std::string recorded(const Folder& folder, const std::string& name, std::uint64_t seed,
                     const std::vector<std::pair<std::string, double>>& hidden) {
  truth::Drive drive;
  drive.sensor.counts = 16384;
  truth::Generator generator(seed);
  for (const auto& [effect, size] : hidden) truth::secret(effect).hide(drive, size, generator);
  const auto law = truth::follow(truth::rich_course(seed, duration, period), truth::Sheet{});
  truth::write_csv(truth::record(drive, law, {.duration = duration, .period = period, .seed = seed}), folder / name);
  return folder / name;
}

Diagnosis changed(const Scenario& scenario, const std::string& before, const std::string& after) {
  return diagnose_since(scenario, {before}, kind_of_data({after}, scenario), {after}, {});
}

std::vector<Change> certain(const Diagnosis& d) {
  std::vector<Change> all;
  for (const Change& c : d.since->changes)
    if (c.certain) all.push_back(c);
  return all;
}

/// A diagnosis by hand: one number, and what the data could show.
Diagnosis fitted(const std::string& effect, const std::string& field, const Unit& unit, double value, double error) {
  Diagnosis d;
  d.uncertainty.effects = {effect};
  d.uncertainty.numbers = {{field, unit, value, error, 0.0, 0.0}};
  d.calibration = {{effect, d.uncertainty.numbers, ""}};
  d.extended = nominal_arm();
  return d;
}

}  // namespace

TEST_CASE("between two recordings the effect that came is told with its size, and not what is stated wrongly",
          "[slow]") {
  const Folder folder;
  Scenario scenario = nominal_arm();
  std::get<MeshParameters<double>>(scenario.mesh).mu = 0.21;  // the truth is 0.25
  const Diagnosis d = changed(scenario, recorded(folder, "before.csv", 5, {}),
                              recorded(folder, "after.csv", 4, {{"worm_viscous", 2e-5}}));
  CAPTURE(d.sentence, d.since->sentence);
  const std::vector<Change> changes = certain(d);
  REQUIRE(changes.size() == 1);
  const Change& c = changes.front();
  CHECK(c.effect == "worm_viscous");
  CHECK(std::abs(c.difference.value - 2e-5) < 3.0 * c.difference.standard_error);
  CHECK(c.difference.standard_error < 0.05 * 2e-5);
  CHECK(d.sentence.rfind("Changed: worm viscous: coefficient 0 -> ", 0) == 0);
  // the scenario that was fitted to the earlier data has the friction that the drive has had all along
  CHECK(std::abs(field_of(d.since->scenario.effects, "mesh_friction", "change").value - 0.04) < 0.002);
}

TEST_CASE("of a drive that stays as it is, hidden friction included, nothing has changed", "[slow]") {
  const Folder folder;
  const Diagnosis d = changed(nominal_arm(), recorded(folder, "before.csv", 1, {{"mesh_friction", 0.02}}),
                              recorded(folder, "after.csv", 2, {{"mesh_friction", 0.02}}));
  CAPTURE(d.sentence);
  CHECK(certain(d).empty());
  CHECK(d.sentence == "Nothing that these data show has changed.");
  CHECK(d.since->verdict == Verdict::named);
}

TEST_CASE("what changed between two break-in tables is told as of recordings", "[slow]") {
  const Folder folder;
  const auto table = [&](const std::string& name, double mu, unsigned seed) {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> noise(1.0, 0.01);
    std::string rows = "load_torque_Nm,motor_torque_Nm\n";
    const double lambda = 4 * unit::degree, ratio = 0.011 / 0.045, cos_phi = std::cos(20 * unit::degree);
    for (int k = 0; k < 10; ++k)
      for (const double s : {1.0, -1.0}) {
        const double load = 0.2 + 0.15 * k, friction = s * mu / cos_phi;  // on an inclined plane
        const double C = ratio * (std::tan(lambda) - friction) / (1.0 + friction * std::tan(lambda));
        rows += fmt::format("{:.6f},{:.9f}\n", load, -C * load * noise(random));
      }
    folder.write(name, rows);
    return folder / name;
  };
  const std::string before = table("before.csv", 0.25, 1), same = table("same.csv", 0.25, 2),
                    after = table("after.csv", 0.30, 3);
  Scenario scenario = nominal_arm();
  std::get<MeshParameters<double>>(scenario.mesh).mu = 0.2;
  const Diagnosis still = changed(scenario, before, same), more = changed(scenario, before, after);
  CAPTURE(still.sentence, more.sentence);
  CHECK(certain(still).empty());
  REQUIRE(certain(more).size() == 1);
  CHECK(certain(more)[0].difference.low < 0.05);
  CHECK(certain(more)[0].difference.high > 0.05);
}

TEST_CASE("a number has changed if the errors of both sides do not explain it") {
  const auto told = [](double before, double error_before, double after, double error_after) {
    const Diagnosis earlier = fitted("mesh_friction", "change", unit::none, before, error_before);
    Diagnosis later = fitted("mesh_friction", "change", unit::none, after, error_after);
    tell_changes(earlier, as_fitted(nominal_arm(), earlier), later);
    return later;
  };
  CHECK(told(0.01, 0.003, 0.02, 0.004).sentence == "Nothing that these data show has changed.");  // 2 errors
  const Diagnosis d = told(0.01, 0.0003, 0.02, 0.0004);
  CHECK(d.sentence == "Changed: mesh friction: change 0.01 -> 0.02 (by +0.01 +- 0.0005).");
  CHECK(std::abs(d.since->changes.at(0).difference.low - (0.01 - 1.96 * 0.0005)) < 1e-12);
}

TEST_CASE("what the earlier data could not show is seen now, and has not changed") {
  Diagnosis earlier;
  earlier.extended = nominal_arm();
  for (const bool shown : {false, true}) {
    earlier.certificate = {{.effect = "worm_viscous",
                            .field = "coefficient",
                            .chosen = "",
                            .unit = unit::newton_metre_second_per_radian,
                            .detectable = 1e-6,
                            .nearest = "",
                            .observable = shown}};
    Diagnosis later = fitted("worm_viscous", "coefficient", unit::newton_metre_second_per_radian, 2e-5, 1e-6);
    later.verdict = Verdict::named;
    std::swap(later.causes, later.calibration);
    tell_changes(earlier, nominal_arm(), later);
    CHECK(later.since->changes.at(0).certain == shown);
    if (!shown)
      CHECK(later.sentence ==
            "Nothing that these data show has changed. Seen now, but the earlier data could not show it: worm "
            "viscous.");
  }
}

TEST_CASE(
    "a phase changes by the shorter way round, and neither faults of recordings nor withdrawn names are changes") {
  const double degree = unit::degree;
  Diagnosis earlier = fitted("cogging", "phase", unit::degrees, 179.0 * degree, 0.1 * degree);
  Diagnosis later = fitted("cogging", "phase", unit::degrees, -179.0 * degree, 0.1 * degree);
  later.uncertainty.effects.push_back("torque_late");
  later.uncertainty.numbers.push_back({"delay", unit::second, 1e-3, 1e-5, 0.0, 0.0});
  later.uncertainty.effects.push_back("worm_coulomb");  // a name that was withdrawn
  later.uncertainty.numbers.push_back({"torque", unit::newton_metre, 1e-3, 1e-5, 0.0, 0.0});
  tell_changes(earlier, as_fitted(nominal_arm(), earlier), later);
  REQUIRE(later.since->changes.size() == 1);
  CHECK(std::abs(later.since->changes[0].difference.value - 2.0 * degree) < 1e-12);
  CHECK(!field_of(as_fitted(nominal_arm(), later).effects, "worm_coulomb", "torque").on);
}

}  // namespace wormdrive::test::diagnosis_changes
