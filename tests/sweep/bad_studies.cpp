// What the commands of a sweep say about bad input, word for word, and what they make of trials that fail.
#include <algorithm>

#include <fmt/format.h>

#include "catch.hpp"
#include "cli/bad_input.hpp"
#include "output/program.hpp"
#include "sweep/studies.hpp"

namespace wormdrive::test::sweep_bad_studies {

TEST_CASE("trials with times that their samples or the run forbid are refused, as their scenarios are", "[sweep]") {
  struct Limit {
    std::string key, column, others;  // others: of the scenario
    double low, high;
    bool (*refuses)(double);
    std::string message;
  };
  for (const Limit& limit :
       {Limit{"controller.tracking_time_s", "controller.tracking_time",
              R"(, "controller.anti_windup=back_calculation", "effect.torque_saturation.limit_Nm=0.05")", 5e-4, 2e-3,
              [](double time) { return time < 1e-3; }, "must be at least the sample time, 0.001 s"},
        Limit{"controller.sample_time_s", "controller.sample_time", "", 1e-3, 0.18,
              [](double time) { return time > 0.1; }, "must be at most the duration, 0.1 s"},
        Limit{"controller.sample_offset_s", "controller.sample_offset", "", 0.0, 0.18,
              [](double time) { return time >= 0.1; }, "must be less than the duration, 0.1 s"}}) {
    const StudyFolder folder("scenario = \"" + shipped("fig10_sliding_014rad_bare.toml") + R"("
set = ["run.solver=taylor", "run.duration_s=0.1", "metrics.from_s=0")" +
                             limit.others + R"(]
[sweep]
design = "monte_carlo"
trials = 40
seed = 3
[[parameter]]
path = ")" + limit.key + fmt::format("\"\ndistribution = \"uniform\"\nlow = {}\nhigh = {}\n", limit.low, limit.high));
    const Outcome outcome = folder.sweep({"-o", "out.h5", "--referee", "0"});
    INFO(limit.key << outcome.out << outcome.err);
    REQUIRE(outcome.exit == 0);
    const std::vector<double> status = folder.column("out.h5", "status"), time = folder.column("out.h5", limit.column);
    long refused = 0;
    for (std::size_t k = 0; k < status.size(); ++k) {
      CHECK(status[k] == (limit.refuses(time[k]) ? 2.0 : 1.0));
      refused += limit.refuses(time[k]);
    }
    CHECK((refused > 3 && refused < 30));
    CHECK(outcome.out.find(limit.message) != std::string::npos);
  }
}

TEST_CASE("trials whose numbers exclude each other are refused, as their scenarios are", "[sweep]") {
  struct Pair {
    std::string set, key, column, message;
  };
  for (const Pair& pair :
       {Pair{"sensor.speed=exact", "sensor.noise_rad", "sensor.noise",
             " has no effect with speed = \"exact\"; remove it, or use speed = \"difference\""},
        Pair{"controller.variation={friction=0.1}", "controller.variation.C1", "controller.variation.C1",
             "controller.variation.friction is stated along with C1 or C2; keep the friction, or the two others"}}) {
    const StudyFolder folder("scenario = \"" + shipped("fig10_sliding_014rad_bare.toml") + R"("
set = ["run.solver=taylor", "run.duration_s=0.1", "metrics.from_s=0", "sensor.speed_filter_Hz=0", ")" +
                             pair.set +
                             R"("]
[sweep]
design = "monte_carlo"
trials = 20
[[parameter]]
path = ")" + pair.key + "\"\ndistribution = \"discrete\"\nvalues = [0, 0, 0.01]\n");
    const Outcome outcome = folder.sweep({"-o", "out.h5", "--referee", "0"});
    INFO(pair.key << outcome.out << outcome.err);
    REQUIRE(outcome.exit == 0);
    const std::vector<double> status = folder.column("out.h5", "status"), value = folder.column("out.h5", pair.column);
    for (std::size_t k = 0; k < status.size(); ++k) CHECK(status[k] == (value[k] > 0.0 ? 2.0 : 1.0));
    CHECK(std::count(status.begin(), status.end(), 2.0) > 2);
    CHECK(outcome.out.find(pair.message) != std::string::npos);
  }
}

TEST_CASE("a bad study is rejected with one line for each fault", "[sweep]") {
  const std::vector<BadStudy> cases{
      {"path = \"mesh.friction\"", "path = \"mesh.frction\"",
       "study.toml:9:8: error: unknown key 'frction' in [mesh]; did you mean 'friction'?"},
      {"path = \"mesh.friction\"", "path = \"mesh.worm_inertia\"",
       "study.toml:9:8: error: unknown key 'worm_inertia' in [mesh]; did you mean 'worm_inertia_kgm2'?"},
      {"path = \"mesh.friction\"", "path = \"run.duration_s\"",
       "study.toml:9:8: error: 'run.duration_s' is not a number of the scenario that a sweep can vary"},
      {"\"effect.worm_coulomb.torque_Nm\"", "\"mesh.friction\"",
       "study.toml:15:8: error: 'mesh.friction' is the same number as 'mesh.friction'; keep one of them"},
      {"trials = 200", "trials = 0", "study.toml:6:10: error: sweep.trials = 0 must be at least 1 and at most 1e+12"},
      {"trials = 200", "trials = 2.5", "study.toml:6:10: error: sweep.trials = 2.5 must be a whole number"},
      {"seed = 3", "seed = 1.5", "study.toml:7:8: error: sweep.seed = 1.5 must be a whole number"},
      {"design = \"monte_carlo\"", "design = \"random\"",
       "study.toml:5:10: error: sweep.design = \"random\" must be one of \"monte_carlo\", \"latin_hypercube\", "
       "\"sobol\", \"saltelli\", \"grid\", \"one_at_a_time\", \"table\", \"morris\", \"shapley\""},
      {"distribution = \"lognormal\"", "distribution = \"gauss\"",
       "study.toml:16:16: error: parameter[1].distribution = \"gauss\" must be one of \"uniform\", \"normal\", "
       "\"truncated_normal\", \"lognormal\", \"triangular\", \"discrete\", \"table\", "
       "\"log_uniform\", \"beta\", \"pert\", \"gumbel\", \"weibull\", \"empirical\", \"row\""},
      {"deviation = 0.05", "deviation = 0",
       "study.toml:12:13: error: parameter[0].deviation = 0 must be greater than 0"},
      {"low = 0.1", "low = 0.1\nhigh = 0.05",
       "study.toml:10:16: error: parameter[0] of 'mesh.friction': low = 0.1 must be less than high = 0.05"},
      {"scenario = \"s.toml\"", "scenario = \"none.toml\"",
       "none.toml: error: cannot be read: No such file or directory"},
      {"seed = 3", "seed = 3\nsed = 1", "study.toml:8:1: error: unknown key 'sed' in [sweep]; did you mean 'seed'?"},
      {"[sweep]", "metrics = [\"final_gear_sped\"]\n[sweep]",
       "study.toml:4:11: error: there is no metric 'final_gear_sped'; did you mean 'final_gear_speed'?"},
      {"metric = \"final_gear_speed\"", "metric = \"error_max\"",
       "study.toml:20:10: error: this study has no metric 'error_max'; valid keys: break_away_events, stop_events, "
       "reversal_events, flank_change_events, final_gear_angle, final_gear_speed"},
      {"[\"run.solver=taylor\"", "[\"run.solver=tailor\"",
       "study.toml:3:7: error: run.solver = \"tailor\" must be one of \"cvode\", \"taylor\""},
      {"[[threshold]]",
       "[[correlation]]\nbetween = [\"mesh.friction\", \"mesh.ratio\"]\ncoefficient = 0.5\n[[threshold]]",
       "study.toml:20:11: error: correlation[0].between names 'mesh.ratio', which is not the path of a [[parameter]]"},
      {"[[threshold]]",
       "[[correlation]]\nbetween = [\"mesh.friction\", \"effect.worm_coulomb.torque_Nm\"]\ncoefficient = 0.9\n"
       "[[correlation]]\nbetween = [\"effect.worm_coulomb.torque_Nm\", \"mesh.friction\"]\ncoefficient = -0.9\n"
       "[[threshold]]",
       "study.toml:23:11: error: correlation[1].between names 'effect.worm_coulomb.torque_Nm' and 'mesh.friction', as "
       "correlation[0] does; keep one of them"},
      {"[[threshold]]",
       "[[parameter]]\npath = \"mesh.ratio\"\ndistribution = \"uniform\"\nlow = 59\nhigh = 61\n"
       "[[correlation]]\nbetween = [\"mesh.friction\", \"effect.worm_coulomb.torque_Nm\"]\ncoefficient = 0.9\n"
       "[[correlation]]\nbetween = [\"mesh.friction\", \"mesh.ratio\"]\ncoefficient = 0.9\n"
       "[[correlation]]\nbetween = [\"mesh.ratio\", \"effect.worm_coulomb.torque_Nm\"]\ncoefficient = -0.9\n"
       "[[threshold]]",
       "study.toml:24:1: error: these correlations contradict each other: their matrix is not positive definite; bring "
       "them closer to 0"},
      {"[sweep]\ndesign = \"monte_carlo\"\ntrials = 200",
       "[[correlation]]\nbetween = [\"mesh.friction\", \"effect.worm_coulomb.torque_Nm\"]\ncoefficient = 0.9\n"
       "[sweep]\ndesign = \"latin_hypercube\"\ntrials = 10000001",
       "study.toml:9:10: error: sweep.trials = 10000001 is too many for a Latin hypercube with a [[correlation]], "
       "which is "
       "held in memory; at most 10000000 are allowed, or use \"sobol\" or \"monte_carlo\""},
      {"design = \"monte_carlo\"\ntrials = 200\nseed = 3\n[[parameter]]\npath = \"mesh.friction\"\n"
       "distribution = \"truncated_normal\"\nmean = 0.25\ndeviation = 0.05\nlow = 0.1",
       "design = \"grid\"\nlevels = 7\n[[parameter]]\npath = \"mesh.friction\"\n"
       "distribution = \"discrete\"\nvalues = [0.2, 0.3]\nlevels = 3",
       "study.toml:5:10: error: sweep.design = \"grid\" takes every value of a discrete parameter once, but "
       "'mesh.friction' has 2 values but states levels = 3; remove them"}};
  check_rejected(good_study, cases);
}

TEST_CASE("Sobol indices of correlated parameters are rejected", "[sweep]") {
  const StudyFolder folder(study_but("design = \"monte_carlo\"\ntrials = 200", "design = \"saltelli\"\nsamples = 20") +
                           "[[correlation]]\nbetween = [\"mesh.friction\", \"effect.worm_coulomb.torque_Nm\"]\n"
                           "coefficient = 0.5\n");
  CHECK(folder.sweep({}).err ==
        "study.toml:5:10: error: sweep.design = \"saltelli\" needs independent parameters, but there is a "
        "[[correlation]]; Sobol indices of dependent parameters do not add up to the variance; use \"shapley\"\n");
}

TEST_CASE("a whole number cannot have a continuous distribution", "[sweep]") {
  const StudyFolder folder(R"(scenario = ")" + shipped("fig10_sliding_014deg_bare.toml") + R"("
[sweep]
design = "monte_carlo"
trials = 2
[[parameter]]
path = "sensor.counts"
distribution = "uniform"
low = 1000
high = 2000
)");
  const Outcome outcome = folder.sweep({});
  CHECK(outcome.exit == 2);
  CHECK(outcome.err ==
        "study.toml:6:8: error: sensor.counts must be a whole number; use \"discrete\" with "
        "whole values\n");
}

TEST_CASE("trials that cannot run become rows with their reason, and the sweep completes", "[sweep]") {
  const std::string failing = study_but("distribution = \"truncated_normal\"\nmean = 0.25\ndeviation = 0.05\nlow = 0.1",
                                        "distribution = \"discrete\"\nvalues = [0.25, -0.1, 20]\nweights = [95, 3, 2]");
  const StudyFolder folder(edited(failing, "trials = 200", "trials = 2000"));
  const Outcome outcome = folder.sweep({"-o", "out.h5"});
  INFO(outcome.out << outcome.err);
  CHECK(outcome.exit == 0);
  const std::vector<double> status = folder.column("out.h5", "status"),
                            friction = folder.column("out.h5", "mesh.friction"),
                            reason = folder.column("out.h5", "reason"),
                            speed = folder.column("out.h5", "final_gear_speed");
  REQUIRE(status.size() == 2000);
  std::map<double, long> with_reason;
  for (std::size_t k = 0; k < status.size(); ++k) {
    const bool good = friction[k] == 0.25;
    REQUIRE(status[k] == (good ? 1.0 : 2.0));
    REQUIRE(std::isfinite(speed[k]) == good);
    ++with_reason[reason[k]];
  }
  const long failed = with_reason[1] + with_reason[2];
  CHECK(with_reason.size() == 3);  // none, and two that differ in more than their numbers
  CHECK(std::abs(failed - 100) < 4 * 10);
  CHECK(outcome.out.find(fmt::format("{} trials: mesh.friction = -0.1 must be at least 0",
                                     std::count(friction.begin(), friction.end(), -0.1))) != std::string::npos);
  CHECK(outcome.out.find("mesh.friction = 20 is not below mu_g = 13.4382") != std::string::npos);
  CHECK(folder
            .run({"replay", "out.h5", "--trial",
                  std::to_string(std::find(friction.begin(), friction.end(), -0.1) - friction.begin()), "-o", "r.h5"})
            .err.ends_with("was refused and has no trajectory: mesh.friction = -0.1 must be at least 0\n"));

  // the eleventh failure is the last row, however many threads were ahead of it
  std::size_t rows = 0;
  for (int failures = 0; failures < 11; ++rows)
    if (status[rows] == 2.0) ++failures;
  std::map<double, long> first;
  for (std::size_t k = 0; k < rows; ++k) ++first[reason[k]];
  const std::string most = first[1] >= first[2] ? "mesh.friction = -0.1 must be at least 0" : "mesh.friction = 20 is";
  for (const char* threads : {"1", "8"}) {
    const Outcome stopped = folder.sweep({"-o", "few.h5", "--max-failures", "10", "--resume", "--threads", threads});
    CHECK(stopped.exit == 3);
    CHECK(stopped.err.starts_with(fmt::format(
        "wormdrive: 11 of {} trials failed, more than --max-failures 10; most frequent reason: {}", rows, most)));
    CHECK(stopped.err.ends_with("; few.h5.part contains all of them\n"));
    CHECK(folder.present("few.h5.part") == rows);
    // once more as it is, then anew
    CHECK(folder.sweep({"-o", "few.h5", "--max-failures", "10", "--resume"}).err == stopped.err);
    std::filesystem::remove(folder / "few.h5.part");
  }
}

TEST_CASE("trials whose controller loses the drive become rows as well", "[sweep]") {
  for (const char* scenario : {"fig10_pid_014rad_bare.toml", "fig10_sliding_014rad_bare.toml"}) {
    const StudyFolder folder(R"(scenario = ")" + shipped(scenario) + R"("
set = ["run.solver=taylor", "run.duration_s=3", "run.report_interval_s=3"]
[sweep]
design = "monte_carlo"
trials = 40
seed = 2
[[parameter]]
path = "controller.sample_time_s"
distribution = "discrete"
values = [1e-3, 0.03]
weights = [95, 5]
)");
    const Outcome outcome = folder.sweep({"-o", "o.h5", "--referee", "1"});
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.exit == 0);
    const std::vector<double> status = folder.column("o.h5", "status"),
                              period = folder.column("o.h5", "controller.sample_time");
    long halted = 0;
    for (std::size_t k = 0; k < status.size(); ++k) {
      REQUIRE(status[k] == (period[k] == 1e-3 ? 1.0 : 3.0));
      halted += status[k] == 3.0;
    }
    CHECK(halted > 0);
    CHECK(outcome.out.find(fmt::format("  failed   {} trial{}: cannot go on at t = ", halted,
                                       halted == 1 ? "" : "s")) != std::string::npos);
    CHECK(outcome.out.find("more than 100000 steps to the next sample or report; the controller does not hold the "
                           "drive, or reports are too far apart") != std::string::npos);
  }
}

TEST_CASE("a sweep is resumed only as the same sweep by the same program", "[sweep][slow]") {
  const StudyFolder folder(study_but("trials = 200", "trials = 500000"));
  REQUIRE(folder.interrupted({"-o", "o.h5"}, SIGINT).exit == 128 + SIGINT);
  const std::string begun = folder.read("o.h5.part");
  const auto refused = [&](const std::vector<std::string>& words, const std::string& message) {
    const Outcome outcome = folder.sweep(words);
    CHECK(outcome.exit == 2);
    CHECK(outcome.err == message);
    CHECK(folder.read("o.h5.part") == begun);
  };
  const std::size_t rows = folder.present("o.h5.part");
  refused({"-o", "o.h5"},
          fmt::format("o.h5.part: error: contains {} of 500000 trials of an interrupted sweep; add --resume to "
                      "continue it, or delete it to start again\n",
                      rows));
  refused({"-o", "o.h5", "--resume", "--shard", "1/2"},
          "o.h5.part: error: cannot be resumed: it contains trials 0 to 499999, not 0 to 249999; repeat its --shard\n");
  folder.write("study.toml", study_but("trials = 200", "trials = 400000"));
  refused({"-o", "o.h5", "--resume"},
          "o.h5.part: error: cannot be resumed: the study differs in sweep.trials: 500000, then 400000; undo the "
          "change, or "
          "delete the file to start again\n");
  folder.write("study.toml", study_but("trials = 200", "trials = 500000  # a comment is no difference"));
  folder.write("s.toml", good_but("ratio = 60", "ratio = 61"));
  refused(
      {"-o", "o.h5", "--resume"},
      "o.h5.part: error: cannot be resumed: the scenario differs in mesh.ratio: 60.0, then 61.0; undo the change, or "
      "delete the file to start again\n");
  folder.write("s.toml", good_scenario);
  {
    const Hdf5Handle part = reopen_hdf5(folder / "o.h5.part");
    H5Adelete(part, "build");
    write_attribute(part, "build", std::string("wormdrive 0.0.1 (abc)"));
  }
  const Outcome other = folder.sweep({"-o", "o.h5", "--resume"});
  CHECK(other.exit == 2);
  CHECK(other.err == fmt::format("o.h5.part: error: cannot be resumed: it was made by wormdrive 0.0.1 (abc), but this "
                                 "program is {}; undo the change, or delete the file to start again\n",
                                 program_identity()));
  folder.write("o.h5.part", "no HDF5");
  CHECK(folder.sweep({"-o", "o.h5", "--resume"}).err ==
        "o.h5.part: error: cannot be resumed: it cannot be opened as HDF5; delete the file to start again\n");
}

TEST_CASE("shards that do not make one sweep are not merged", "[sweep][slow]") {
  const StudyFolder folder;
  for (const char* k : {"1", "2", "3"})
    REQUIRE(folder.sweep({"-o", std::string(k) + ".h5", "--shard", std::string(k) + "/3"}).exit == 0);
  const auto says = [&](std::vector<std::string> words, const std::string& message) {
    words.insert(words.begin(), "merge");
    words.insert(words.end(), {"-o", "m.h5"});
    const Outcome outcome = folder.run(words);
    CHECK(outcome.exit == 2);
    CHECK(outcome.err == message + "\n");
    CHECK_FALSE(folder.names().contains("m.h5"));
  };
  says({"1.h5", "3.h5"}, "3.h5: error: no shard contains trials 67 to 133 before it");
  says({"1.h5", "2.h5"}, "2.h5: error: no shard contains trials 134 to 199 after it");
  says({"1.h5", "2.h5", "2.h5", "3.h5"}, "2.h5: error: another shard also contains trials 67 to 133");
  says({"1.h5", "s.toml"}, "s.toml: error: it cannot be opened as HDF5");
  folder.write("study.toml", study_but("seed = 3", "seed = 4"));
  REQUIRE(folder.sweep({"-o", "other.h5", "--shard", "2/3"}).exit == 0);
  says({"1.h5", "other.h5", "3.h5"},
       "other.h5: error: is not a shard of the same sweep as 1.h5: the study differs in sweep.seed: 4, then 3");
  const auto made_by_another = [&](const std::string& shard) {
    const Hdf5Handle file = reopen_hdf5(folder / shard);
    H5Adelete(file, "build");
    write_attribute(file, "build", std::string("wormdrive 0.0.1 (abc)"));
  };
  made_by_another("2.h5");
  says({"1.h5", "2.h5", "3.h5"},
       fmt::format("2.h5: error: is not a shard of the same sweep as 1.h5: it was made by wormdrive 0.0.1 (abc), but "
                   "that one by {}",
                   program_identity()));
  made_by_another("1.h5");
  made_by_another("3.h5");
  says({"1.h5", "2.h5", "3.h5"},
       fmt::format("1.h5: error: cannot be merged: it was made by wormdrive 0.0.1 (abc), but this program is {}",
                   program_identity()));
  CHECK(folder.sweep({"--shard", "4/3"}).err == "--shard 4/3: error: must be i/n with 1 <= i <= n, as in 3/7\n");
}

}  // namespace wormdrive::test::sweep_bad_studies
