// What a sweep answers beside its rows: summary, referee, kept trajectories, worst case, pictures.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "numbers.hpp"
#include "output/hdf5/fixed_table.hpp"
#include "sweep/studies.hpp"
#include "sweep/study/distribution.hpp"

namespace wormdrive::test::sweep_answers {

namespace {

std::vector<double> summary_column(const StudyFolder& folder, const std::string& file, const std::string& path) {
  return read_column(open_hdf5(folder / file), "summary/" + path);
}
std::vector<std::string> summary_texts(const StudyFolder& folder, const std::string& file, const std::string& path) {
  return read_fixed_texts(open_hdf5(folder / file), "summary/" + path);
}

/// A closed loop with a friction that its controller does not know.
const std::string closed = R"(scenario = ")" + shipped("fig10_sliding_014deg_bare.toml") + R"("
set = ["run.solver=taylor", "run.report_interval_s=1"]
[sweep]
design = "monte_carlo"
trials = 20
seed = 5
[[parameter]]
path = "effect.mesh_friction.change"
distribution = "uniform"
low = -0.025
high = 0.025
)";

}  // namespace

TEST_CASE("without a threshold trials are ranked by the first metric with a unit, not by a count", "[sweep]") {
  const StudyFolder folder(good_study.substr(0, good_study.find("[[threshold]]")));
  REQUIRE(folder.sweep({"-o", "o.h5"}).exit == 0);
  const Outcome told = folder.run({"summary", "o.h5", "--json"});
  REQUIRE(told.exit == 0);
  CHECK(nlohmann::json::parse(told.out)["ranked_by"] == "final_gear_angle");
}

TEST_CASE("/summary holds the numbers that the command prints", "[sweep]") {
  const StudyFolder folder(study_but("= -2.5", "= -0.3"));
  REQUIRE(folder.sweep({"-o", "o.h5"}).exit == 0);
  const Outcome told = folder.run({"summary", "o.h5", "--worst", "10", "--json"});
  REQUIRE(told.exit == 0);
  const auto json = nlohmann::json::parse(told.out);
  const std::vector<std::string> names = summary_texts(folder, "o.h5", "metrics/name");
  CHECK(names.size() == 6);
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto& metric = json["metrics"][names[k]];
    INFO(names[k]);
    CHECK(metric["mean"] == summary_column(folder, "o.h5", "metrics/mean")[k]);
    CHECK(metric["quantiles"]["0.95"]["high"] == summary_column(folder, "o.h5", "metrics/quantile_95_high")[k]);
    CHECK(metric["count"] == summary_column(folder, "o.h5", "metrics/count")[k]);
  }
  // the share of the threshold, counted here
  const std::vector<double> speed = folder.column("o.h5", "final_gear_speed");
  const auto missed = static_cast<double>(std::count_if(speed.begin(), speed.end(), [](double v) { return v < -0.3; }));
  CHECK(missed > 0.0);
  CHECK(summary_column(folder, "o.h5", "thresholds/missed") == std::vector{missed});
  CHECK(summary_column(folder, "o.h5", "thresholds/of") == std::vector{200.0});
  CHECK(summary_column(folder, "o.h5", "statuses/trials") == std::vector{200.0, 0.0, 0.0});
  // the worst are the least, for the threshold is missed below
  const std::vector<double> worst = summary_column(folder, "o.h5", "worst/value");
  std::vector<double> rising = speed;
  std::sort(rising.begin(), rising.end());
  CHECK(worst == std::vector(rising.begin(), rising.begin() + 10));
  const std::vector<double> trial = summary_column(folder, "o.h5", "worst/trial");
  for (std::size_t k = 0; k < 10; ++k) CHECK(speed[static_cast<std::size_t>(trial[k])] == worst[k]);
  CHECK(summary_texts(folder, "o.h5", "influences/parameter").size() == 2);
}

TEST_CASE("the summary starts with the limits of the study and names Lemma 1's conditions in words", "[sweep]") {
  const Folder folder;
  REQUIRE(folder.run({"sweep", shipped("studies/fig10_sliding.toml"), "-o", "o.h5", "--referee", "1", "-q"}).exit == 0);
  const std::string out = folder.run({"summary", "o.h5"}).out;
  INFO(out);
  std::size_t at = 0;
  for (const std::string words :
       {"bare gear\n  limit    error_max at most 0.00637 rad: missed in 0 of 200 trials, 0 [0, 1.828] % (95 % "
        "interval, ",
        "\n  limit    error_peak_to_peak at most 0.00087 rad: ", "\n  trials   200 of 200\n", "\n  metric  ",
        "\n  the same in all trials: 0 for time_outside_layer, layer_reached, layer_violations, precision_violations, ",
        "\n  Lemma 1: margin of each condition, negative if it fails\n",
        " of 200   C1 within its variation: |C1/C1_hat - 1| <= controller.variation.C1 (condition_10)\n",
        "\n  the same margin in all trials: 0 for beta1 >= 2, D1 >= |d - d_hat|, ",
        "\n  influence on error_max, the largest first\n", "\n  worst trials\n",
        "\n  referee  cvode repeated 1 trial under the recorded torque: "}) {
    INFO(words);
    const std::size_t found = out.find(words, at);
    REQUIRE(found != std::string::npos);
    at = found;
  }
  CHECK(out.find("\n  condition_") == std::string::npos);
}

TEST_CASE("only the trajectories of named and of the worst trials are kept", "[sweep]") {
  const StudyFolder folder(study_but("seed = 3", "seed = 3\nkeep = [7, 123]\nkeep_worst = 2"));
  const Outcome outcome = folder.sweep({"-o", "o.h5"});
  REQUIRE(outcome.exit == 0);
  std::set<std::string> names{"s.toml", "study.toml", "o.h5", "o_trial_7.h5", "o_trial_123.h5"};
  const std::vector<double> worst = summary_column(folder, "o.h5", "worst/trial");
  for (const double trial : {worst[0], worst[1]}) names.insert(fmt::format("o_trial_{:.0f}.h5", trial));
  CHECK(names.size() == 7);
  CHECK(folder.names() == names);
  CHECK(read_column(open_hdf5(folder / "o_trial_123.h5"), "trajectory/gear_speed").back() ==
        folder.column("o.h5", "final_gear_speed")[123]);

  folder.write("study.toml", study_but("seed = 3", "seed = 3\nkeep = [200]"));
  CHECK(folder.sweep({"-o", "p.h5"}).err ==
        "study.toml:8:8: error: sweep.keep names trial 200, which does not exist; the trials are 0 to 199\n");
  folder.write("study.toml", study_but("seed = 3", "seed = 3\nkeep_worst = 1\nkeep_worst_by = \"final_gear_anle\""));
  CHECK(folder.sweep({"-o", "p.h5"}).err ==
        "study.toml: error: sweep.keep_worst_by = \"final_gear_anle\": this study has no such metric; did you mean "
        "'final_gear_angle'?\n");
}

TEST_CASE("the referee agrees with the fast path, and reports where it does not", "[sweep][slow]") {
  const StudyFolder folder(closed);
  const Outcome outcome = folder.sweep({"-o", "o.h5", "--referee", "5"});
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit == 0);
  CHECK(outcome.out.find("  referee  cvode repeated 5 trials under the recorded torque: angles agree within ") !=
        std::string::npos);
  CHECK(outcome.out.find("  referee  2 of them in closed loop as well: angles agree within ") != std::string::npos);
  CHECK(outcome.out.find("differs") == std::string::npos);
  const auto verdicts = [&](const std::string& file, const std::string& column) {
    return read_column(open_hdf5(folder / file), "referee/" + column);
  };
  const std::vector<double> judged = verdicts("o.h5", "judged"), angle = verdicts("o.h5", "angle_difference");
  CHECK(std::count(judged.begin(), judged.end(), 1.0) == 5);
  CHECK(std::count(judged.begin(), judged.end(), 0.0) == 995);
  double largest = 0.0;
  for (int k = 0; k < 5; ++k) largest = std::max(largest, angle[k]);
  CHECK(largest > 0.0);  // two solvers never agree to the last digit
  CHECK(largest < 1e-8);

  // the same sample whatever the number of threads, and a line with every trial beyond the tolerance
  folder.write("study.toml", edited(closed, "seed = 5", "seed = 5\nreferee_tolerance_rad = 1e-300"));
  const Outcome strict = folder.sweep({"-o", "strict.h5", "--referee", "5", "--threads", "1"});
  CHECK(verdicts("strict.h5", "trial") == verdicts("o.h5", "trial"));
  CHECK(verdicts("strict.h5", "angle_difference") == angle);
  CHECK(strict.out.find("  referee  cvode differs by more than 1e-300 rad, or fails, in 5 of them: trials ") !=
        std::string::npos);
  CHECK(folder.run({"summary", "strict.h5"}).out.find("differs by more than 1e-300 rad") != std::string::npos);
}

TEST_CASE("with a sensor that rounds to counts the referee reports when the counts first differ", "[sweep]") {
  const StudyFolder folder(edited(closed, "run.solver=taylor", "run.solver=taylor\", \"sensor.counts=100000000"));
  const Outcome outcome = folder.sweep({"-o", "o.h5", "--referee", "5"});
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit == 0);
  const Hdf5Handle file = open_hdf5(folder / "o.h5");
  const auto verdicts = [&](const std::string& column) { return read_column(file, "referee/" + column); };
  const std::vector<double> replayed = verdicts("angle_difference"), closed_loop = verdicts("closed_angle_difference"),
                            parted = verdicts("parted"), trial = verdicts("trial");
  double first = std::numeric_limits<double>::infinity();
  long count = 0;
  for (std::size_t k = 0; k < 5; ++k) {  // the first and the fifth have their own controller
    CHECK(replayed[k] < 1e-8);
    CHECK(std::isnan(closed_loop[k]));
    if (std::isnan(parted[k])) continue;
    ++count;
    first = std::min(first, parted[k]);
  }
  REQUIRE(count > 0);
  CHECK(first > 0.0);
  CHECK(outcome.out.find(fmt::format(
            "in closed loop the sensor's counts differ from some time on in {} of them; first in trial ", count)) !=
        std::string::npos);
  CHECK(outcome.out.find(fmt::format(" at {:.6g} s\n", first)) != std::string::npos);
  CHECK(outcome.out.find("differs") == std::string::npos);
}

TEST_CASE("the worst case is the expected corner of the box", "[sweep]") {
  const StudyFolder folder(study_but("trials = 200", "trials = 50"));
  REQUIRE(folder.sweep({"-o", "o.h5"}).exit == 0);
  const Outcome outcome = folder.run({"worst", "o.h5", "-o", "worst.h5", "--tail", "0.01", "--evaluations", "800"});
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit == 0);
  // the less friction, the faster backward
  const double speed = read_column(open_hdf5(folder / "worst.h5"), "trajectory/gear_speed").back();
  CHECK(speed < summary_column(folder, "o.h5", "worst/value")[0]);
  TruncatedNormal friction{0.25, 0.05};
  friction.low = 0.1;
  const Outcome corner =
      folder.run({"run", "s.toml", "-q", "-o", "corner.h5", "--set", "run.solver=taylor", "--set",
                  fmt::format("mesh.friction={}", friction.quantile(0.01)), "--set",
                  fmt::format("effect.worm_coulomb.torque_Nm={}", Lognormal{1e-3, 0.5}.quantile(0.01))});
  INFO(corner.err);
  REQUIRE(corner.exit == 0);
  const double there = read_column(open_hdf5(folder / "corner.h5"), "trajectory/gear_speed").back();
  CHECK(std::abs(speed - there) <= 1e-5 * std::abs(there));
  CHECK(outcome.out.find("  referee  cvode: final_gear_speed ") != std::string::npos);
}

TEST_CASE("the whole box is searched for the worst case, not only where the sweep's worst trials are", "[sweep]") {
  // under sin(w t) for a second an inertia of 1 ends at (1 - cos w)/w: a lobe for each hertz, the first the highest
  const auto varied = [](int k) {
    return fmt::format(
        "[[parameter]]\npath = \"motor.torque[{}].frequency_Hz\"\ndistribution = \"uniform\"\nlow = 0.2\nhigh = 10\n",
        k);
  };
  const StudyFolder folder("scenario = \"free.toml\"\n[sweep]\ndesign = \"monte_carlo\"\ntrials = 4\nseed = 4\n" +
                           varied(0) + varied(1));
  const std::string torque =
      "[[motor.torque]]\nkind = \"sinusoid\"\namplitude_Nm = 1\nfrequency_Hz = 5\nphase_deg = -90\n";
  folder.write("free.toml", "[mesh]\nkind = \"none\"\ninertia_kgm2 = 1\n" + torque + torque +
                                "[run]\nduration_s = 1\nreport_interval_s = 1\n");
  REQUIRE(folder.sweep({"-o", "o.h5"}).exit == 0);
  const Outcome outcome =
      folder.run({"worst", "o.h5", "-o", "worst.h5", "--metric", "final_gear_speed", "--evaluations", "400"});
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit == 0);
  const double speed = read_column(open_hdf5(folder / "worst.h5"), "trajectory/gear_speed").back();
  CHECK(close(speed, 2.0 * (1.0 - std::cos(2.331122)) / 2.331122, 1e-4));
}

TEST_CASE("a sweep is drawn, alone and with runs of its trials", "[sweep][slow]") {
  const StudyFolder folder(closed);
  REQUIRE(folder.sweep({"-o", "o.h5", "-q"}).exit == 0);
  for (const char* trial : {"3", "4"})
    REQUIRE(folder.run({"replay", "o.h5", "--trial", trial, "-o", std::string(trial) + ".h5", "-q"}).exit == 0);
  const Outcome drawn = folder.run({"plot", "o.h5"}),
                over = folder.run({"plot", "o.h5", "3.h5", "4.h5", "-o", "over.png"});
  CHECK(drawn.err.empty());
  CHECK(drawn.exit == 0);
  CHECK(over.err.empty());
  CHECK(over.exit == 0);
  for (const char* picture : {"o.png", "over.png"}) CHECK(std::filesystem::file_size(folder / picture) > 10'000);
}

}  // namespace wormdrive::test::sweep_answers
