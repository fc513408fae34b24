// What a sweep has made is safe: trials that are done before slow ones, and the file of one who writes it.
#include <algorithm>
#include <chrono>
#include <list>
#include <thread>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "sweep/file/sweep_file.hpp"
#include "sweep/studies.hpp"
#include "sweep/study/load_study.hpp"

namespace wormdrive::test::sweep_safety {

namespace {

/// 200 trials of a millisecond, but one of the first ten that takes thousands of them.
const std::string one_slow_trial = R"(scenario = ")" + shipped("fig10_pid_014rad_bare.toml") + R"("
set = ["run.solver=taylor", "run.report_interval_s=3"]
[sweep]
design = "latin_hypercube"
trials = 200
seed = 35
[[parameter]]
path = "controller.sample_time_s"
distribution = "discrete"
values = [1e-7, 1e-3]
weights = [1, 199]
[[parameter]]
path = "mesh.friction"
distribution = "uniform"
low = 0.24
high = 0.26
)";

/// What `summary` says of a sweep so far.
nlohmann::json so_far(const StudyFolder& folder, const std::string& file) {
  const Outcome outcome = folder.run({"summary", file, "--json"});
  return outcome.exit == 0 ? nlohmann::json::parse(outcome.out) : nlohmann::json{{"trials", 0}};
}

}  // namespace

TEST_CASE("a slow trial delays no other: kill -9 loses only trials that have not ended", "[sweep][slow]") {
  const StudyFolder folder(one_slow_trial);
  const int signal = GENERATE(SIGKILL, SIGTERM);
  {
    const Process process({WORMDRIVE_PROGRAM, "sweep", "study.toml", "-o", "o.h5", "--threads", "2"}, folder.path());
    // the others, and the last second
    for (nlohmann::json now; (now = so_far(folder, "o.h5")).at("trials") < 199;) {
      REQUIRE(now.value("running", true));
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    process.kill(signal);
    if (signal == SIGTERM) process.kill(SIGKILL);  // a batch system that does not wait for the slow one
  }
  CHECK(folder.present("o.h5.part") == 199);
  const std::vector<double> status = folder.column("o.h5.part", "status");
  const auto slow = std::find(status.begin(), status.end(), 0.0) - status.begin();
  CHECK(slow < 10);

  const Outcome summary = folder.run({"summary", "o.h5"});
  CHECK(summary.out.find("  trials   199 of 200 so far; the sweep was interrupted\n") != std::string::npos);
  const Outcome resumed = folder.sweep({"-o", "o.h5", "--resume", "--threads", "2", "--referee", "0"});
  INFO(resumed.err);
  REQUIRE(resumed.exit == 0);
  CHECK(resumed.out.find("; 199 were already complete") != std::string::npos);
  CHECK(folder.column("o.h5", "controller.sample_time")[static_cast<std::size_t>(slow)] == 1e-7);
  CHECK(folder.present("o.h5") == 200);
  CHECK(folder.names() == std::set<std::string>{"s.toml", "study.toml", "o.h5"});
}

TEST_CASE("the file of trials does not depend on their order, including reasons", "[sweep]") {
  const StudyFolder folder(study_but("trials = 200", "trials = 12"));
  const Study study = load_study(folder / "study.toml");
  const auto trial = [&](std::uint64_t index, TrialStatus status, const std::string& reason) {
    return Trial{index, std::vector<double>(study.parameters.size(), static_cast<double>(index)),
                 std::vector<double>(study.metrics.size(), 0.5), status, reason};
  };
  std::vector<Trial> trials;
  for (std::uint64_t k = 0; k < 12; ++k) trials.push_back(trial(k, TrialStatus::done, ""));
  trials[3] = trial(3, TrialStatus::refused, "mesh.friction = -1 must be at least 0");
  trials[4] = trial(4, TrialStatus::halted, "cannot go on at t = 3 s: chatter");
  trials[7] = trial(7, TrialStatus::refused, "mesh.friction = -7 must be at least 0");
  trials[9] = trial(9, TrialStatus::halted, "cannot go on at t = 9 s: chatter");
  const auto write = [&](const std::string& name, const std::vector<std::size_t>& order, std::size_t at_once) {
    SweepFile::create(folder / name, study, {0, 12}, "wormdrive sweep study.toml");
    {
      SweepFile file(folder / name, study, {0, 12});
      for (std::size_t k = 0; k < order.size(); ++k) {
        file.append(trials[order[k]]);
        if ((k + 1) % at_once == 0) file.flush();
      }
      if (order.size() < 12) return;
      file.finish();
    }
  };
  write("in_order.h5", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11}, 5);
  const auto is_in_order = [&](const std::string& name) {
    INFO(name);
    CHECK(folder.rows(name) == folder.rows("in_order.h5"));
    const std::vector<std::string> reasons{"mesh.friction = -1 must be at least 0", "cannot go on at t = 3 s: chatter"};
    CHECK(SweepReader(folder / name).reasons() == reasons);
    CHECK(bytes(open_hdf5(folder / name), "summary/worst") ==
          bytes(open_hdf5(folder / "in_order.h5"), "summary/worst"));
  };
  write("backward.h5", {11, 10, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0}, 1);
  write("mixed.h5", {9, 0, 11, 4, 7, 1, 3, 2, 8, 10, 5, 6}, 3);
  write("gone_on.h5", {9, 7, 11, 2}, 2);
  {
    const ReasonTable reasons = SweepReader(folder / "gone_on.h5.part").counted_reasons();
    CHECK(reasons.total() == 2);
    SweepFile rest(folder / "gone_on.h5", study, {0, 12}, reasons);
    for (const std::size_t k : {10, 8, 6, 5, 4, 3, 1, 0}) rest.append(trials[k]);
    rest.finish();
  }
  for (const char* name : {"in_order.h5", "backward.h5", "mixed.h5", "gone_on.h5"}) is_in_order(name);
  CHECK(folder.names() ==
        std::set<std::string>{"s.toml", "study.toml", "in_order.h5", "backward.h5", "mixed.h5", "gone_on.h5"});
}

TEST_CASE("of four processes that write one result only one succeeds, and the others say why", "[sweep][slow]") {
  const StudyFolder folder(study_but("trials = 200", "trials = 1000"));
  folder.write("s.toml", good_scenario);
  REQUIRE(folder.sweep({"-o", "whole.h5"}).exit == 0);
  for (const char* k : {"1", "2"})
    REQUIRE(folder.sweep({"-o", std::string(k) + ".h5", "--shard", std::string(k) + "/2"}).exit == 0);
  const auto rows = folder.rows("whole.h5");
  const auto names = folder.names();
  const std::vector<std::vector<std::string>> commands{
      {"sweep", "study.toml", "-o", "o.h5", "--threads", "1"},
      {"sweep", "study.toml", "-o", "o.h5", "--threads", "1", "--resume"},
      {"merge", "1.h5", "2.h5", "-o", "o.h5"},
      {"run", "s.toml", "-o", "o.h5"}};
  for (const auto& command : commands)
    for (int round = 0; round < 8; ++round) {
      std::vector<std::string> words{WORMDRIVE_PROGRAM};
      words.insert(words.end(), command.begin(), command.end());
      std::list<Process> four;
      for (int k = 0; k < 4; ++k) four.emplace_back(words, folder.path());
      int winners = 0;
      for (Process& process : four) {
        const Outcome outcome = process.wait();
        INFO(command.front() << ", round " << round << ": " << outcome.err);
        winners += outcome.exit == 0;
        CHECK((outcome.exit == 0 || outcome.exit == 2 || outcome.exit == 4));
        const bool late = outcome.err ==
                          "wormdrive: cannot write o.h5: it holds a finished sweep; choose another name, or replace it "
                          "with --force\n";
        if (outcome.exit == 4 && !late)
          CHECK(outcome.err == "wormdrive: cannot write o.h5.part: another program is writing it\n");
        // who comes late finds a result that is not replaced
        if (outcome.exit == 2) CHECK(outcome.err.starts_with("o.h5: error: "));
      }
      CHECK(winners >= 1);
      if (command.front() != "run") REQUIRE(folder.rows("o.h5") == rows);
      std::filesystem::remove(folder / "o.h5");
      REQUIRE(folder.names() == names);
    }
}

TEST_CASE("a lock left by a killed program locks nothing", "[sweep]") {
  const StudyFolder folder;
  folder.write("o.h5.part.lock", "");
  CHECK(folder.sweep({"-o", "o.h5"}).exit == 0);
  CHECK(folder.names() == std::set<std::string>{"s.toml", "study.toml", "o.h5"});
}

TEST_CASE("a running sweep can be summarised, reported and compared", "[sweep][slow]") {
  const StudyFolder folder(edited(edited(one_slow_trial, "trials = 200", "trials = 400000"), "1e-7", "9e-4"));
  Process process({WORMDRIVE_PROGRAM, "sweep", "study.toml", "-o", "o.h5", "--threads", "1"}, folder.path());
  nlohmann::json now{{"trials", 0}};
  while (now.at("trials") == 0) now = so_far(folder, "o.h5");
  CHECK(now.at("running") == true);
  CHECK(now.at("of") == 400000);
  CHECK(now.at("done") == now.at("trials"));
  for (const char* name : {"o.h5", "o.h5.part"}) {
    const Outcome summary = folder.run({"summary", name});
    INFO(summary.err);
    CHECK(summary.exit == 0);
    CHECK(summary.out.find(" of 400000 so far; the sweep is still running\n") != std::string::npos);
    CHECK(summary.out.find(fmt::format("see a trial: wormdrive replay {} --trial ", name)) != std::string::npos);
  }
  const Outcome report = folder.run({"report", "o.h5"});
  INFO(report.err);
  CHECK(report.exit == 0);
  CHECK(folder.read("o.html").find(" of 400000 trials so far, ") != std::string::npos);
  CHECK(folder.run({"replay", "o.h5", "--trial", "0", "-o", "r.h5"}).exit == 0);
  process.kill(SIGINT);
  CHECK(process.wait().exit == 128 + SIGINT);
  const Outcome ended = folder.run({"summary", "o.h5"});
  CHECK(ended.out.find(fmt::format("  trials   {} of 400000 so far; the sweep was interrupted\n",
                                   folder.present("o.h5.part"))) != std::string::npos);
  CHECK(folder.run({"diff", "o.h5", "o.h5.part"}).exit == 0);
}

}  // namespace wormdrive::test::sweep_safety
