#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "diagnosis/data/torque_spikes.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/report/diagnosis_folder.hpp"
#include "diagnosis/report/diagnosis_json.hpp"
#include "recovery/campaign.hpp"
#include "recovery/spoiled_torque.hpp"

// What goes wrong between a drive and its file: the ground truth of the recovery tests is recorded, its columns are
// spoiled here, and the diagnosis has to name the fault and not some physics.

namespace wormdrive::test::diagnosis_recording_faults {

namespace {

using recovery::reread;

constexpr double period = 1e-3;

recovery::Case bench_case(std::uint64_t seed) {
  recovery::Case drawn{recovery::Kind::nothing, recovery::conditions("ideal"), seed, {}};
  drawn.duration = 6.0;
  return drawn;
}

Recording recorded(const recovery::Case& drawn) { return recovery::record(drawn).recording; }

Diagnosis diagnosed(const Recording& recording) {
  return diagnose(recovery::data_sheet(recovery::conditions("ideal")), {recording}, {.threads = 2});
}

struct Fault {
  std::string id;
  std::function<void(Recording&)> spoil;
  double size, share;    ///< of the only number, and how close it has to come
  std::string remedy{};  ///< a part of it
};

/// What is said where nothing but this fault is found.
Diagnosis only_fault(const Fault& fault, std::uint64_t seed) {
  Recording recording = recorded(bench_case(seed));
  fault.spoil(recording);
  Diagnosis d = diagnosed(recording);
  CAPTURE(fault.id, d.sentence);
  REQUIRE(d.causes.size() == 1);
  CHECK(d.causes[0].effect == fault.id);
  CHECK(d.verdict == Verdict::named);
  CHECK(std::abs(d.causes[0].parameters[0].value / fault.size - 1.0) < fault.share);
  CHECK(d.sentence.starts_with("The recording is faulty: "));
  CHECK(d.sentence.find(fault.remedy) != std::string::npos);
  return d;
}

}  // namespace

TEST_CASE("a fault of the recording is named with its size and its remedy, and leaves the drive as it is", "[slow]") {
  const std::vector<Fault> faults{
      {"torque_late", [](Recording& r) { reread(r.motor_torque, [](double k) { return k - 4.0; }); }, 4e-3, 0.02,
       "shift the torque by 4 ms towards the start"},
      {"torque_filtered", [](Recording& r) { recovery::filter(r.motor_torque, 5e-3 / period); }, 5e-3, 0.02,
       "went through a filter of 5"},
      {"clock_drift", [](Recording& r) { reread(r.motor_torque, [](double k) { return k - 1e-3 * k + 0.5; }); }, 1e-3,
       0.1, "Log torque and angle by one clock"},
      {"time_scale", [](Recording& r) { r.period *= 1.024; }, 0.024, 0.05, "Multiply the times in the file by 0.97"}};
  for (std::size_t k = 0; k < faults.size(); ++k) {
    const Diagnosis d = only_fault(faults[k], 41 + k);
    d.extended.effects.for_each([&]<class E>(const std::optional<E>& effect) {
      INFO(E::id);
      CHECK_FALSE(effect);
    });
    const nlohmann::json cause = as_json(d, "", {}).at("causes").at(0);
    CHECK(d.sentence.find(cause.at("remedy").get<std::string>()) != std::string::npos);
    CHECK(extended_file(d).find("# A fault of the recording and not of the drive: " + faults[k].id) !=
          std::string::npos);
  }
}

TEST_CASE("clocks that part by more than the torque remembers are told", "[slow]") {
  std::uint64_t seed = 45;
  for (const double share : {0.004, 0.016, -0.009})
    only_fault(
        {"clock_drift", [&](Recording& r) { reread(r.motor_torque, [&](double k) { return k - share * k + 0.5; }); },
         share, 0.05, "Log torque and angle by one clock"},
        seed++);
}

TEST_CASE("torques that never acted are told from those that did") {
  const auto spikes = [](std::vector<double>& torque, double size) {
    std::mt19937_64 random(7);
    std::uniform_int_distribution<std::size_t> any(500, torque.size() - 500);
    for (int k = 0; k < 8; ++k) torque[any(random)] = k % 2 == 0 ? size : -size;
  };
  only_fault({"torque_spikes", [&](Recording& r) { spikes(r.motor_torque, 0.5); }, 1.0, 0.1, "Leave these rows out"},
             51);

  // the same torques from a controller that commands them
  std::vector<double> kicks(6000, 0.0);
  spikes(kicks, 0.5);
  const auto law = [&, follow = truth::follow(truth::rich_course(51, 6.0), truth::Sheet{})](double t, double seen) {
    return follow(t, seen) + kicks[std::min<std::size_t>(5999, static_cast<std::size_t>(std::lround(t / period)))];
  };
  const truth::Recording kicked = truth::record(truth::Drive{}, law, {.duration = 6.0, .seed = 51});
  Recording recording;
  recording.period = period;
  recording.motor_torque = kicked.motor_torque;
  recording.gear_angle = kicked.gear_angle;
  REQUIRE(torque_spikes(recording).size() >= 8);
  const Diagnosis d = diagnosed(recording);
  CAPTURE(d.sentence);
  CHECK(d.causes.empty());
}

TEST_CASE("an effect is named beside a fault of the recording") {
  recovery::Case drawn = bench_case(61);
  drawn.kind = recovery::Kind::single;
  const truth::Secret& viscous = truth::secret("worm_viscous");
  drawn.hidden = {{&viscous, truth::Size::large, viscous.large}};
  Recording recording = recorded(drawn);
  reread(recording.motor_torque, [](double k) { return k - 3.0; });
  const Diagnosis d = diagnosed(recording);
  CAPTURE(d.sentence);
  REQUIRE(d.causes.size() == 2);
  for (const EstimatedEffect& cause : d.causes) {
    const double size = cause.remedy.empty() ? viscous.large : 3.0 * period;
    CHECK(cause.effect == (cause.remedy.empty() ? "worm_viscous" : "torque_late"));
    CHECK(std::abs(cause.parameters[0].value / size - 1.0) < 0.05);
  }
  CHECK(d.sentence.starts_with("The simulation lacks worm viscous: "));
  CHECK(d.sentence.find(" The recording is faulty: torque late: ") != std::string::npos);
  CHECK(std::get<std::optional<WormViscous<double>>>(d.extended.effects.list));
}

TEST_CASE("an encoder whose steps are longer than the way between two samples makes no false alarm") {
  for (const double counts : {1000.0, 2000.0}) {
    recovery::Case drawn = bench_case(71);
    drawn.conditions.counts = counts;
    const Diagnosis d = diagnosed(recorded(drawn));
    CAPTURE(counts, d.sentence);
    CHECK(d.verdict == Verdict::adequate);
    CHECK(std::any_of(d.remarks.begin(), d.remarks.end(), [](const std::string& remark) {
      return remark.find("count as one together") != std::string::npos;
    }));
  }
}

TEST_CASE("a ratio that is stated wrongly is told where an inertia of the worm does the same") {
  const Recording recording = recorded(bench_case(81));
  Scenario sheet = recovery::data_sheet(recovery::conditions("ideal"));
  auto& mesh = std::get<MeshParameters<double>>(sheet.mesh);
  const double true_ratio = mesh.i;
  mesh.i = 45.0;
  const Diagnosis d = diagnose(sheet, {recording}, {.threads = 2});
  CAPTURE(d.sentence, d.remarks);
  CHECK(std::any_of(d.remarks.begin(), d.remarks.end(), [&](const std::string& remark) {
    return remark.starts_with("a ratio of 60 in place of 45 would do the same as this inertia of the worm");
  }));
  REQUIRE(true_ratio == 60.0);
}

}  // namespace wormdrive::test::diagnosis_recording_faults
