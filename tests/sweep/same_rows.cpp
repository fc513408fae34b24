// The rows of a sweep are the same bits however it is made.
#include <algorithm>
#include <chrono>
#include <random>
#include <thread>

#include <fmt/format.h>

#include "catch.hpp"
#include "sweep/studies.hpp"

namespace wormdrive::test::sweep_same_rows {

namespace {

const std::string many = study_but("trials = 200", "trials = 60000");

}  // namespace

TEST_CASE("without the processor's own sine, fused multiplication and vectors the rows are the same", "[sweep]") {
  // a closed loop: it makes a flipped last bit grow
  const StudyFolder folder(
      edited(study_but("s.toml", shipped("fig10_sliding_014deg_bare.toml")), "trials = 200", "trials = 20"));
  REQUIRE(folder.sweep({"-o", "all.h5"}).exit == 0);
  setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-AVX512F,-AVX2,-AVX,-FMA,-FMA4,-AVX2_Usable,-FMA_Usable,-FMA4_Usable", 1);
  const Outcome plain = folder.sweep({"-o", "plain.h5"});
  unsetenv("GLIBC_TUNABLES");
  INFO(plain.err);
  REQUIRE(plain.exit == 0);
  CHECK(folder.rows("plain.h5") == folder.rows("all.h5"));
}

TEST_CASE("1, 2 and 8 threads give the same rows", "[sweep][slow]") {
  for (const std::string& study :
       {good_study, study_but("monte_carlo", "latin_hypercube"), study_but("monte_carlo", "sobol"), lanes_study}) {
    const StudyFolder folder(study);
    for (const char* threads : {"1", "2", "8"}) {
      const Outcome outcome = folder.sweep({"-o", std::string(threads) + ".h5", "--threads", threads});
      INFO(outcome.err);
      REQUIRE(outcome.exit == 0);
    }
    const auto one = folder.rows("1.h5");
    CHECK(one.at("index").size() == 200 * sizeof(double));
    CHECK(one == folder.rows("2.h5"));
    CHECK(one == folder.rows("8.h5"));
  }
}

TEST_CASE("another seed gives other rows", "[sweep]") {
  const StudyFolder folder;
  REQUIRE(folder.sweep({"-o", "a.h5"}).exit == 0);
  folder.write("study.toml", study_but("seed = 3", "seed = 4"));
  REQUIRE(folder.sweep({"-o", "b.h5"}).exit == 0);
  CHECK(folder.rows("a.h5") != folder.rows("b.h5"));
}

TEST_CASE("seven shards merged in any order equal the whole sweep", "[sweep][slow]") {
  const auto study = GENERATE(as<std::string>(), study_but("monte_carlo", "latin_hypercube"), lanes_study);
  const StudyFolder folder(study);
  REQUIRE(folder.sweep({"-o", "whole.h5"}).exit == 0);
  std::vector<std::string> merge{"merge"};
  for (int k = 7; k >= 1; --k) {
    const std::string shard = std::to_string(k) + ".h5";
    REQUIRE(folder.sweep({"-o", shard, "--shard", std::to_string(k) + "/7"}).exit == 0);
    merge.push_back(shard);
  }
  merge.insert(merge.end(), {"-o", "merged.h5"});
  const Outcome merged = folder.run(merge);
  INFO(merged.err);
  REQUIRE(merged.exit == 0);
  CHECK(folder.rows("merged.h5") == folder.rows("whole.h5"));
}

TEST_CASE("a sweep killed 20 times at random and resumed equals the whole sweep", "[sweep][slow]") {
  const std::string few = "trials = 200", enough = "trials = 10000";  // to be killed among them
  const auto study = GENERATE_COPY(as<std::string>(), study_but(few, enough), edited(lanes_study, few, enough));
  const StudyFolder folder(study);
  const auto begin = std::chrono::steady_clock::now();
  REQUIRE(folder.sweep({"-o", "whole.h5"}).exit == 0);
  const std::chrono::duration<double> whole = std::chrono::steady_clock::now() - begin;
  const auto rows = folder.rows("whole.h5");
  const auto is_whole = [&] {
    CHECK(folder.rows("killed.h5") == rows);
    CHECK(folder.names() == std::set<std::string>{"s.toml", "study.toml", "whole.h5", "killed.h5"});
    std::filesystem::remove(folder / "killed.h5");
  };
  const unsigned seed = std::random_device()();
  INFO("seed " << seed);
  std::mt19937 random(seed);
  int killed = 0, resumed = 0;
  double reach = 0.25;  // of the time that the whole takes; a busy machine needs more of it to come to its first row
  while (killed < 20 || resumed < 5) {
    const bool begun = folder.present("killed.h5.part") > 0;
    Process process({WORMDRIVE_PROGRAM, "sweep", "study.toml", "-o", "killed.h5", "--resume"}, folder.path());
    std::this_thread::sleep_for(reach * whole * std::generate_canonical<double, 32>(random));
    process.kill();
    const Outcome outcome = process.wait();
    if (outcome.exit == 128 + SIGKILL)
      ++killed;
    else if (outcome.exit == 0)
      is_whole();  // it was faster: once more
    else
      FAIL(outcome.err);
    if (begun)
      ++resumed;
    else
      reach = std::min(1.0, 1.2 * reach);
  }
  const Outcome last = folder.sweep({"-o", "killed.h5", "--resume"});
  INFO(last.err);
  REQUIRE(last.exit == 0);
  is_whole();
}

TEST_CASE("SIGTERM ends a sweep, which keeps its trials and prints how to continue", "[sweep][slow]") {
  const int signal = GENERATE(SIGTERM, SIGUSR1);  // a batch system's, and what it has mpirun pass on
  const StudyFolder folder(many);
  REQUIRE(folder.sweep({"-o", "whole.h5"}).exit == 0);
  const Outcome ended = folder.interrupted({"-o", "ended.h5"}, signal);
  CHECK(ended.exit == 128 + signal);
  CHECK(ended.err ==
        fmt::format("wormdrive: interrupted after {} of 60000 trials, which are in ended.h5.part; continue "
                    "with: wormdrive sweep study.toml -o ended.h5 --resume\n",
                    folder.present("ended.h5.part")));
  REQUIRE(folder.sweep({"-o", "ended.h5", "--resume"}).exit == 0);
  CHECK(folder.rows("ended.h5") == folder.rows("whole.h5"));
}

TEST_CASE("a signal that a process gets twice at once, for itself and for its group, is one signal", "[sweep][slow]") {
  const StudyFolder folder(many);
  const Outcome ended = folder.interrupted({"-o", "ended.h5"}, SIGTERM, 2);
  CHECK(ended.exit == 128 + SIGTERM);
  CHECK(ended.err.starts_with("wormdrive: interrupted after "));
}

TEST_CASE("a full disk loses no stored row, and the sweep can be resumed", "[sweep][slow]") {
  const StudyFolder folder(many);
  REQUIRE(folder.sweep({"-o", "whole.h5"}).exit == 0);
  constexpr rlim_t room = 2'000'000;
  const Outcome none = folder.run({"sweep", "study.toml", "-o", "full.h5"}, room);
  CHECK(none.exit == 4);
  CHECK(none.err == "wormdrive: cannot write full.h5.part.part: File too large\n");
  CHECK(folder.names() == std::set<std::string>{"s.toml", "study.toml", "whole.h5"});

  folder.interrupted({"-o", "full.h5"}, SIGINT);
  const std::size_t before = folder.present("full.h5.part");
  const Outcome full = folder.run({"sweep", "study.toml", "-o", "full.h5", "--resume"}, room);
  CHECK(full.exit == 4);
  CHECK(full.err.starts_with("wormdrive: cannot write full.h5.part"));
  CHECK(
      full.err.ends_with("File too large; trials older than a second are safe; free some space, then continue with: "
                         "wormdrive sweep study.toml -o full.h5 --resume\n"));
  CHECK(folder.present("full.h5.part") >= before);
  const Outcome resumed = folder.sweep({"-o", "full.h5", "--resume"});
  INFO(full.err << resumed.err);
  REQUIRE(resumed.exit == 0);
  CHECK(resumed.out.find(" were already complete") != std::string::npos);
  CHECK(folder.rows("full.h5") == folder.rows("whole.h5"));
}

TEST_CASE("a complete sweep is not run again", "[sweep]") {
  const StudyFolder folder;
  REQUIRE(folder.sweep({"-o", "o.h5"}).exit == 0);
  const auto made = std::filesystem::last_write_time(folder / "o.h5");
  const Outcome again = folder.sweep({"-o", "o.h5", "--resume"});
  CHECK(again.exit == 0);
  CHECK(again.out.ends_with("  resume   o.h5 already contains every trial\n"));
  CHECK(std::filesystem::last_write_time(folder / "o.h5") == made);
}

TEST_CASE("a trial runs again with its trajectory and the same metrics, with either solver", "[sweep]") {
  const StudyFolder folder;
  for (const char* solver : {"taylor", "cvode"}) {
    // reports that no sample or step meets
    folder.write("study.toml",
                 study_but("[\"run.solver=taylor\", \"run.report_interval_s=0.01\"]",
                           fmt::format("[\"run.solver={}\", \"run.report_interval_s=0.00037\"]", solver)));
    REQUIRE(folder.sweep({"-o", "sweep.h5", "--force"}).exit == 0);
    const Outcome outcome = folder.run({"replay", "sweep.h5", "--trial", "123", "-o", "run.h5"});
    INFO(outcome.err);
    CHECK(outcome.exit == 0);
    CHECK(outcome.out.find("every metric equals that of the sweep to the last bit") != std::string::npos);
    CHECK(read_column(open_hdf5(folder / "run.h5"), "trajectory/gear_speed").back() ==
          folder.column("sweep.h5", "final_gear_speed")[123]);
  }
}

}  // namespace wormdrive::test::sweep_same_rows
