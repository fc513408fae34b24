#include <nlohmann/json.hpp>

#include "cli/bad_input.hpp"
#include "diagnosis/break_in_data.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/fitting/hypothesis.hpp"
#include "diagnosis/fitting/noise_sizes.hpp"
#include "diagnosis/recordings.hpp"
#include "diagnosis/report/diagnosis_json.hpp"
#include "support.hpp"

// Several files are one body of data: in which order they are given makes no difference.

namespace wormdrive::test::diagnosis_order_of_files {

using nlohmann::json;

namespace {

Recording sweep(double noise, std::uint64_t seed) {
  return record(nominal_arm(), {.duration = 4.0, .white_torque = noise, .angle_noise = noise * 0.06, .seed = seed});
}

/// Noise that is found in recordings of the arm as it is stated.
NoiseSizes noise_of(std::vector<Recording> recordings) {
  std::vector<PreparedRecording> all;
  std::size_t blocks = 0;
  for (const Recording& r : recordings) {
    all.push_back(prepared(r, blocks, 60.0));
    blocks += all.back().blocks();
  }
  const Evaluation evaluation(nominal_arm(), InnovationLayout(std::move(all)), 1);
  Hypothesis h;
  REQUIRE(evaluate(evaluation, h));
  return noise_sizes(evaluation, h);
}

json diagnosed(const Folder& folder, const std::string& scenario, const std::vector<std::string>& files) {
  std::vector<std::string> words{"diagnose", scenario, "-o", "out", "-q", "--no-pictures"};
  words.insert(words.begin() + 2, files.begin(), files.end());
  const Outcome outcome = folder.run(words);
  INFO(outcome.err);
  REQUIRE(outcome.exit == 0);
  json found = json::parse(folder.read("out/diagnosis.json"));
  found.at("data").erase("files");
  return found;
}

}  // namespace

TEST_CASE("noise is that of all recordings, in whatever order they stand") {
  const Recording quiet = sweep(2e-4, 1), loud = sweep(2e-3, 2);
  const NoiseSizes a = noise_of({quiet}), b = noise_of({loud}), both = noise_of({quiet, loud}),
                   turned = noise_of({loud, quiet});
  CHECK(both.angle > 1.2 * a.angle);
  CHECK(both.angle < b.angle);
  CHECK(std::abs(both.angle - turned.angle) <= 1e-12 * both.angle);
  CHECK(std::abs(both.torque - turned.torque) <= 1e-12 * both.torque);
}

TEST_CASE("two recordings are diagnosed alike in either order, to the last digit", "[slow]") {
  Scenario truth = nominal_arm();
  set_field(truth.effects, {"worm_coulomb", "torque", 2e-3});
  const Recording a = record(truth, {.duration = 4.0, .seed = 1}), b = record(truth, {.duration = 3.5, .seed = 2});
  const auto told = [](const Diagnosis& d) { return as_json(d, "a recording over time", {}); };
  CHECK(told(diagnose(nominal_arm(), {a, b})) == told(diagnose(nominal_arm(), {b, a})));
}

TEST_CASE("break-in tables and records at constant speed are diagnosed alike in either order of their files",
          "[slow]") {
  const Folder folder;
  folder.write("a.csv", break_in_csv(0.25, 0.03, 3));
  folder.write("b.csv", break_in_csv(0.25, 0.03, 4));
  const std::string arm = shipped("fig07_break_in_07cm_forward.toml");
  CHECK(diagnosed(folder, arm, {"a.csv", "b.csv"}) == diagnosed(folder, arm, {"b.csv", "a.csv"}));

  std::string slow = "record,worm_speed_rad_per_s,motor_torque_Nm\n", fast = slow;
  for (int k = 1; k <= 6; ++k)
    for (const int way : {-1, 1})
      (k % 3 == 0 ? fast : slow) +=
          fmt::format("r{0}{1},{2},{3}\nr{0}{1},{2},{4}\n", k, way < 0 ? "b" : "f", way * 2.0 * k,
                      way * (0.004 + 2e-4 * k) + 1e-5 * (k % 5), way * (0.004 + 2e-4 * k));
  folder.write("slow.csv", slow);
  folder.write("fast.csv", fast);
  const std::string drive = shipped("measured_worm_drive.toml");
  CHECK(diagnosed(folder, drive, {"slow.csv", "fast.csv"}) == diagnosed(folder, drive, {"fast.csv", "slow.csv"}));
}

}  // namespace wormdrive::test::diagnosis_order_of_files
