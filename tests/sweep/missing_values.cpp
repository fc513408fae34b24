// Trials without a value of a metric: refused, halted, or what it is the time of never happened.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "sweep/studies.hpp"
#include "sweep/study/load_study.hpp"
#include "sweep/summary/statistics.hpp"
#include "sweep/summary/summary.hpp"

namespace wormdrive::test::sweep_missing_values {

namespace {

/// A sliding controller that starts outside its layer with a motor that may be too weak ever to reach it.
const std::string weak_motors = R"(scenario = ")" + shipped("fig10_sliding_014deg_bare.toml") + R"("
set = ["run.solver=taylor", "run.duration_s=1", "run.report_interval_s=1", "metrics.from_s=0.3", "initial.gear_angle_deg=20"]
[sweep]
design = "monte_carlo"
trials = 60
seed = 1
[[parameter]]
path = "effect.torque_saturation.limit_Nm"
distribution = "discrete"
values = [0.0001, 5]
[[threshold]]
metric = "layer_reached"
above_s = 0.5
[[threshold]]
metric = "layer_reached"
below_s = 1e-9
[[threshold]]
metric = "layer_violations"
above = 1e9
)";

/// An open loop of which some trials are refused.
const std::string some_refused =
    study_but("distribution = \"truncated_normal\"\nmean = 0.25\ndeviation = 0.05\nlow = 0.1",
              "distribution = \"discrete\"\nvalues = [0.25, 0.3, -0.1]\nweights = [60, 20, 20]");

nlohmann::json summary_of(const StudyFolder& folder, std::vector<std::string> words = {}) {
  words.insert(words.begin(), {"summary", "o.h5", "--json"});
  const Outcome told = folder.run(words);
  INFO(told.err);
  REQUIRE(told.exit == 0);
  return nlohmann::json::parse(told.out);
}
std::vector<double> summary_column(const StudyFolder& folder, const std::string& path) {
  return read_column(open_hdf5(folder / "o.h5"), "summary/" + path);
}

}  // namespace

TEST_CASE("an event that never happened misses an upper limit, keeps a lower one and is the worst", "[sweep]") {
  const StudyFolder folder(weak_motors);
  REQUIRE(folder.sweep({"-o", "o.h5", "--referee", "0"}).exit == 0);
  const std::vector<double> reached = folder.column("o.h5", "layer_reached"),
                            limit = folder.column("o.h5", "effect.torque_saturation.limit"),
                            broken = folder.column("o.h5", "layer_violations");
  long never = 0, late = 0;
  for (std::size_t k = 0; k < reached.size(); ++k) {
    REQUIRE(std::isnan(reached[k]) == (limit[k] < 0.1));
    REQUIRE(std::isnan(broken[k]) == std::isnan(reached[k]));  // nothing can be said of what comes after it
    never += std::isnan(reached[k]);
    late += reached[k] > 0.5;
  }
  REQUIRE(never > 10);
  REQUIRE(never < 50);
  REQUIRE(late == 0);
  const auto json = summary_of(folder);
  const auto& thresholds = json["thresholds"];
  REQUIRE(thresholds.size() == 3);
  CHECK(thresholds[0]["missed"] == never);
  CHECK(thresholds[0]["kept"] == 60 - never);
  CHECK(thresholds[0]["of"] == 60);
  CHECK(thresholds[0]["share"]["low"] == probability(static_cast<std::uint64_t>(never), 60).low);
  CHECK(thresholds[1]["missed"] == 0);
  CHECK(thresholds[2]["missed"] == never);
  CHECK(summary_column(folder, "thresholds/missed") ==
        std::vector{static_cast<double>(never), 0.0, static_cast<double>(never)});
  CHECK(json["metrics"]["layer_reached"]["without"] == never);
  CHECK(json["metrics"]["layer_reached"]["count"] == 60 - never);
  const std::vector<std::string> names = read_fixed_texts(open_hdf5(folder / "o.h5"), "summary/metrics/name");
  const auto place = std::find(names.begin(), names.end(), "layer_reached") - names.begin();
  CHECK(std::isinf(summary_column(folder, "metrics/quantile_99")[static_cast<std::size_t>(place)]));
}

TEST_CASE("a run that never reaches the layer does not claim to keep the promises within it", "[sweep]") {
  const Folder folder;
  const Outcome told = folder.run({"run", shipped("fig10_sliding_014deg_bare.toml"), "-o", "o.h5", "--set",
                                   "run.duration_s=1", "--set", "metrics.from_s=0.3", "--set",
                                   "initial.gear_angle_deg=20", "--set", "effect.torque_saturation.limit_Nm=0.0001"});
  REQUIRE(told.exit == 0);
  CHECK(told.out.find("  Lemma 1  the layer is never reached; the promises for the time after that cannot be "
                      "checked\n") != std::string::npos);
}

TEST_CASE("refused trials are counted among all, listed separately and ranked as the worst", "[sweep]") {
  const StudyFolder folder(some_refused);
  REQUIRE(folder.sweep({"-o", "o.h5"}).exit == 0);
  const std::vector<double> status = folder.column("o.h5", "status"), speed = folder.column("o.h5", "final_gear_speed"),
                            friction = folder.column("o.h5", "mesh.friction");
  const auto refused = static_cast<std::uint64_t>(std::count(status.begin(), status.end(), 2.0));
  const auto missed =
      static_cast<std::uint64_t>(std::count_if(speed.begin(), speed.end(), [](double v) { return v < -2.5; }));
  REQUIRE(refused > 20);
  const auto json = summary_of(folder);
  const auto& threshold = json["thresholds"][0];
  CHECK(threshold["missed"] == missed);
  CHECK(threshold["refused"] == refused);
  CHECK(threshold["halted"] == 0);
  CHECK(threshold["kept"] == 200 - refused - missed);
  CHECK(threshold["of"] == 200);
  CHECK(threshold["not_kept"]["high"] == probability(missed + refused, 200).high);
  const Outcome told = folder.run({"summary", "o.h5"});
  CHECK(told.out.find(fmt::format("           {} refused, 0 halted, {} kept; missed, refused or halted: ", refused,
                                  200 - refused - missed)) != std::string::npos);
  CHECK(told.out.find("refused: mesh.friction = -0.1 must be at least 0, mesh.friction -0.1") != std::string::npos);
  for (const auto& trial : json["worst"]) {
    CHECK(trial["status"] == "refused");
    CHECK(trial["reason"] == "mesh.friction = -0.1 must be at least 0");
  }
  // less speed is worse, and less friction makes less: with those that are refused at -0.1 it goes one way
  CHECK(json["influences"][0]["parameter"] == "mesh.friction");
  CHECK(summary_column(folder, "worst/status") == std::vector<double>(10, 2.0));
  CHECK(std::isnan(summary_column(folder, "worst/value")[0]));

  const auto done = summary_of(folder, {"--done-only"});
  CHECK(done["thresholds"][0]["of"] == 200 - refused);
  CHECK(done["thresholds"][0]["refused"] == 0);
  CHECK(done["metrics"]["final_gear_speed"]["without"] == 0);
  for (const auto& trial : done["worst"]) CHECK(trial["status"] == "done");

  const Outcome worst = folder.run({"worst", "o.h5", "-o", "worst.h5"});
  CHECK(worst.exit == 2);
  CHECK(worst.err == fmt::format("o.h5: error: trial {} is the worst but cannot run: mesh.friction = -0.1 must be at "
                                 "least 0; --done-only considers only drives that can\n",
                                 std::find(status.begin(), status.end(), 2.0) - status.begin()));
  CHECK(folder.run({"worst", "o.h5", "-o", "worst.h5", "--done-only", "--evaluations", "40"}).exit == 0);
  CHECK(folder.run({"report", "o.h5"}).exit == 0);
  CHECK(folder.read("o.html").find("more were refused and 0 halted") != std::string::npos);
}

TEST_CASE("a quantile among missing values is the worst value, not an invented number", "[sweep]") {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const auto quantile = [](const std::vector<double>& rising, double p) {
    return sample_quantile(quantile_ranks(rising.size(), p), [&](std::uint64_t rank) { return rising.at(rank); }).value;
  };
  CHECK(quantile({1.0, 2.0, infinite, infinite}, 0.25) == 1.75);
  CHECK(quantile({1.0, 2.0, infinite, infinite}, 0.5) == infinite);
  CHECK(quantile({1.0, 2.0, infinite, infinite}, 0.99) == infinite);
  CHECK(quantile({-infinite, -infinite, 1.0, 2.0}, 0.05) == -infinite);
  CHECK(quantile({-infinite, 1.0}, 0.5) == -infinite);
}

TEST_CASE("a missing value misses every limit", "[sweep]") {
  const Threshold above{"error_max", 1.0, true}, below{"error_max", 1.0, false};
  for (const Threshold& threshold : {above, below}) {
    CHECK(threshold.missed_by(std::nan("")));
    CHECK_FALSE(threshold.missed_by(1.0));
  }
  CHECK(above.missed_by(1.5));
  CHECK_FALSE(below.missed_by(1.5));
}

TEST_CASE("a design that is not a random sample has no confidence intervals", "[sweep][slow]") {
  const StudyFolder folder(study_but("design = \"monte_carlo\"\ntrials = 200", "design = \"grid\"\nlevels = 5"));
  REQUIRE(folder.sweep({"-o", "o.h5"}).exit == 0);
  const Outcome told = folder.run({"summary", "o.h5"});
  CHECK(told.out.find("interval") == std::string::npos);
  CHECK(told.out.find('[') == std::string::npos);
  const auto json = summary_of(folder);
  CHECK(json["sample"] == false);
  CHECK(json.dump().find("\"low\"") == std::string::npos);
  CHECK(json.dump().find("\"high\"") == std::string::npos);
  for (const char* column : {"metrics/quantile_50_low", "metrics/quantile_95_high", "thresholds/share_low",
                             "thresholds/share_high", "thresholds/not_kept_low", "thresholds/not_kept_high"})
    for (const double value : summary_column(folder, column)) CHECK(std::isnan(value));
  REQUIRE(folder.run({"report", "o.h5"}).exit == 0);
  CHECK(folder.read("o.html").find("confidence") == std::string::npos);
  CHECK(folder.run({"plot", "o.h5"}).exit == 0);
}

}  // namespace wormdrive::test::sweep_missing_values
