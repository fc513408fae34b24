// Ranks that share a sweep make the rows that one process makes, also when one of them is lost.
#include "sweep/ranks/ranks.hpp"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <thread>
#include <unistd.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include "catch.hpp"
#include "sweep/file/sweep_file.hpp"
#include "sweep/mpirun.hpp"
#include "sweep/studies.hpp"

namespace wormdrive::test::sweep_ranks {

namespace {

/// Variables of the environment, as long as it lives.
class Environment {
 public:
  explicit Environment(std::vector<std::pair<std::string, std::string>> variables) : variables_(std::move(variables)) {
    for (const auto& [name, value] : variables_) setenv(name.c_str(), value.c_str(), 1);
  }
  Environment(const Environment&) = delete;
  ~Environment() {
    for (const auto& [name, value] : variables_) unsetenv(name.c_str());
  }

 private:
  std::vector<std::pair<std::string, std::string>> variables_;
};

}  // namespace

TEST_CASE("1, 2 and 4 ranks give the rows of one process", "[sweep][slow]") {
  if (!has_mpi()) return;
  const auto study = GENERATE(as<std::string>(), good_study, lanes_study);
  const StudyFolder folder(edited(study, "trials = 200", "trials = 2000"));
  REQUIRE(folder.sweep({"-o", "alone.h5"}).exit == 0);
  for (const char* count : {"1", "2", "4"}) {
    const std::string file = std::string(count) + ".h5";
    const Outcome outcome = Process(on_ranks(count, {"-o", file}), folder.path()).wait();
    INFO(outcome.err);
    REQUIRE(outcome.exit == 0);
    CHECK(folder.rows(file) == folder.rows("alone.h5"));
  }
  CHECK(folder.names() == std::set<std::string>{"s.toml", "study.toml", "alone.h5", "1.h5", "2.h5", "4.h5"});
}

TEST_CASE("a lost rank loses its last trials, which any number of ranks can run again", "[sweep][slow]") {
  if (!has_mpi()) return;
  const StudyFolder folder(study_but("trials = 200", "trials = 100000"));
  REQUIRE(folder.sweep({"-o", "alone.h5"}).exit == 0);
  Process job(on_ranks("2", {"-o", "ranks.h5"}), folder.path());
  while (rows_so_far(folder / "ranks.h5.rank_1_1.part", "trials/status") == 0) usleep(1000);
  REQUIRE(lose_a_rank());
  CHECK(job.wait().exit != 0);
  CHECK_FALSE(folder.names().contains("ranks.h5"));
  std::size_t kept = 0;
  for (const std::string& name : folder.names())
    if (name.starts_with("ranks.h5.rank_")) {
      const int part = open((folder / name).c_str(), O_RDONLY);
      REQUIRE(flock(part, LOCK_SH) == 0);  // waits: the other rank may outlive mpirun for a moment
      ::close(part);
      kept += folder.present(name);
    }
  CHECK(kept > 0);

  const Outcome anew = Process(on_ranks("2", {"-o", "ranks.h5"}), folder.path()).wait();
  CHECK(anew.exit == 2);
  CHECK(anew.err.find("of 100000 trials of an interrupted sweep; add --resume to continue it") != std::string::npos);

  SECTION("of four ranks") {
    const Outcome outcome = Process(on_ranks("4", {"-o", "ranks.h5", "--resume"}), folder.path()).wait();
    INFO(outcome.err);
    REQUIRE(outcome.exit == 0);
    CHECK(outcome.out.find(" were already complete") != std::string::npos);
  }
  SECTION("or a single process") {
    const Outcome outcome = folder.sweep({"-o", "ranks.h5", "--resume"});
    INFO(outcome.err);
    REQUIRE(outcome.exit == 0);
    CHECK(outcome.out.find(" were already complete") != std::string::npos);
  }
  CHECK(folder.rows("ranks.h5") == folder.rows("alone.h5"));
  CHECK(folder.names() == std::set<std::string>{"s.toml", "study.toml", "alone.h5", "ranks.h5"});
}

TEST_CASE("ranks resume the sweep of a single process", "[sweep][slow]") {
  if (!has_mpi()) return;
  const StudyFolder folder(study_but("trials = 200", "trials = 60000"));
  REQUIRE(folder.sweep({"-o", "alone.h5"}).exit == 0);
  REQUIRE(folder.interrupted({"-o", "ranks.h5"}, SIGINT).exit == 128 + SIGINT);
  const Outcome outcome = Process(on_ranks("2", {"-o", "ranks.h5", "--resume"}), folder.path()).wait();
  INFO(outcome.err);
  REQUIRE(outcome.exit == 0);
  CHECK(folder.rows("ranks.h5") == folder.rows("alone.h5"));
}

TEST_CASE("ranks stop at --max-failures with the message of a single process", "[sweep][slow]") {
  if (!has_mpi()) return;
  const StudyFolder folder(edited(lanes_study, "trials = 200", "trials = 4000"));
  const auto told = [](const std::string& said) {  // "11 of 432 trials failed, ...; most frequent reason: ..."
    const std::size_t begin = said.find("wormdrive: ");
    return said.substr(begin, said.find("; ", said.find("most frequent")) - begin);
  };
  const Outcome alone = folder.sweep({"-o", "alone.h5", "--max-failures", "10"});
  REQUIRE(alone.exit == 3);
  REQUIRE(told(alone.err).starts_with("wormdrive: 11 of "));
  for (const char* count : {"2", "4"}) {
    const std::string file = std::string(count) + ".h5";
    const Outcome outcome = Process(on_ranks(count, {"-o", file, "--max-failures", "10"}), folder.path()).wait();
    CHECK(outcome.exit == 3);
    CHECK(told(outcome.err) == told(alone.err));
    // what was there counts when it goes on
    const Outcome again =
        Process(on_ranks(count, {"-o", file, "--max-failures", "10", "--resume"}), folder.path()).wait();
    CHECK(again.exit == 3);
    CHECK(told(again.err) == told(alone.err));
  }
}

/// What each of some ranks does in the test that follows: portions of a time in which it does not call MPI.
TEST_CASE("a rank takes slow portions", "[.][slow]") {
  Ranks ranks(false);
  int made = 0;
  for (; ranks.add({1}).front() < 40; ++made) std::this_thread::sleep_for(std::chrono::milliseconds(50));
  CHECK(ranks.sum(static_cast<std::uint64_t>(made)) == 40);
  std::cout << fmt::format("rank {} of {} made {}\n", ranks.rank(), ranks.count(), made);
}

TEST_CASE("ranks share slow portions evenly on any MPI transport", "[sweep][slow]") {
  if (!has_mpi()) return;
  using Variables = std::vector<std::pair<std::string, std::string>>;
  const auto variables = GENERATE(Variables{}, Variables{{"OMPI_MCA_btl", "tcp,self"}});
  const Environment environment(variables);
  const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
  const Outcome outcome = Process({mpirun, "-n", "2", self, "a rank takes slow portions"}, "/").wait();
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit == 0);
  for (const std::string rank : {"rank 0 of 2 made ", "rank 1 of 2 made "}) {
    const std::size_t at = outcome.out.find(rank);
    REQUIRE(at != std::string::npos);
    const int made = std::stoi(outcome.out.substr(at + rank.size()));
    CHECK(made >= 15);
    CHECK(made <= 25);
  }
}

TEST_CASE("a sweep on ranks prints how many trials each rank has run", "[sweep]") {
  if (!has_mpi()) return;
  const StudyFolder folder;
  const Outcome outcome = Process(on_ranks("2", {"-o", "o.h5"}), folder.path()).wait();
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit == 0);
  const std::size_t at = outcome.out.find(" on 2 ranks, ");
  REQUIRE(at != std::string::npos);
  const std::string told = outcome.out.substr(at, outcome.out.find('\n', at) - at);
  CHECK((told.find(" to ") != std::string::npos || told.find(" on 2 ranks, 100 each, ") == 0));
}

TEST_CASE("the processes of srun find each other by PMIx", "[sweep]") {
  if (!has_mpi()) return;
  const StudyFolder folder;
  REQUIRE(folder.sweep({"-o", "alone.h5"}).exit == 0);
  // mpirun is a server of PMIx as srun --mpi=pmix is: what it says beside is taken away
  const std::string as_srun =
      "export SLURM_STEP_NUM_TASKS=2 SLURM_PROCID=$OMPI_COMM_WORLD_RANK; unset OMPI_COMM_WORLD_SIZE "
      "OMPI_COMM_WORLD_RANK; exec \"$0\" sweep study.toml --threads 1 -o o.h5";
  const Outcome outcome =
      Process({mpirun, "-n", "2", "/bin/sh", "-c", as_srun, WORMDRIVE_PROGRAM}, folder.path()).wait();
  INFO(outcome.out << outcome.err);
  REQUIRE(outcome.exit == 0);
  CHECK(outcome.out.find(" on 2 ranks, ") != std::string::npos);
  CHECK(folder.rows("o.h5") == folder.rows("alone.h5"));
  CHECK(folder.names() == std::set<std::string>{"s.toml", "study.toml", "alone.h5", "o.h5"});
}

TEST_CASE("processes that cannot find each other are rejected in one line", "[sweep]") {
  const StudyFolder folder;
  const std::string cure =
      mpirun.empty() ? "this wormdrive was built without MPI; install libopenmpi-dev and build it again, or give every "
                       "process its own --shard\n"
                     : "";
  {
    const Environment srun({{"SLURM_STEP_NUM_TASKS", "4"}, {"SLURM_PROCID", "0"}});
    const Outcome outcome = folder.sweep({"-o", "o.h5"});
    CHECK(outcome.exit == 2);
    CHECK(outcome.err ==
          "srun: error: " + (cure.empty() ? "has started 4 processes that cannot find each other; start them with srun "
                                            "--mpi=pmix or with mpirun, or give every process its own --shard\n"
                                          : cure));
    CHECK(folder.sweep({"-o", "shard.h5", "--shard", "1/4"}).exit == 0);
  }
  {
    const Environment srun({{"SLURM_STEP_NUM_TASKS", "4"}, {"SLURM_PROCID", "3"}});
    const Outcome outcome = folder.sweep({"-o", "o.h5"});
    CHECK(outcome.exit == 2);
    CHECK(outcome.err.empty());  // the first one has told it
  }
  if (has_mpi()) {
    const Environment of_another_mpi({{"PMI_SIZE", "4"}, {"PMI_RANK", "0"}});
    const Outcome outcome = folder.sweep({"-o", "o.h5"});
    CHECK(outcome.exit == 2);
    CHECK(
        outcome.err.starts_with("mpirun: error: has started 4 processes, but MPI finds 1: it belongs to another MPI "
                                "than the one wormdrive was built with, "));
    CHECK(outcome.err.ends_with("; start them with the mpirun of that MPI, or give every process its own --shard\n"));
    CHECK(std::count(outcome.err.begin(), outcome.err.end(), '\n') == 1);
  }
  CHECK(folder.names() == std::set<std::string>{"s.toml", "study.toml", "shard.h5"});
  {
    const Environment batch_script({{"SLURM_JOB_ID", "1"}, {"SLURM_NTASKS", "4"}, {"SLURM_PROCID", "0"}});
    CHECK(folder.sweep({"-o", "o.h5"}).exit == 0);
  }
}

TEST_CASE("bad input on ranks is reported once", "[sweep]") {
  if (!has_mpi()) return;
  const StudyFolder folder(study_but("trials = 200", "trials = 0"));
  const Outcome outcome = Process(on_ranks("2", {"-o", "ranks.h5"}), folder.path()).wait();
  CHECK(outcome.exit == 2);
  const std::string message = "study.toml:6:10: error: sweep.trials = 0 must be at least 1 and at most 1e+12\n";
  CHECK(outcome.err.find(message) != std::string::npos);
  CHECK(outcome.err.find(message) == outcome.err.rfind(message));
}

TEST_CASE("a place that may not be written has the exit code of a single process on ranks", "[sweep]") {
  if (!has_mpi()) return;
  const StudyFolder folder;
  folder.write("mine.txt", "somebody's");
  const std::string message = folder.sweep({"-o", "mine.txt"}).err;
  const Outcome outcome = Process(on_ranks("2", {"-o", "mine.txt"}), folder.path()).wait();
  CHECK(outcome.exit == 4);
  CHECK(outcome.err.find(message) != std::string::npos);
  CHECK(outcome.err.find(message) == outcome.err.rfind(message));
}

TEST_CASE("on ranks the referee judges as many trials as it is told, however they are shared", "[sweep]") {
  if (!has_mpi()) return;
  const StudyFolder folder;
  for (const std::size_t wanted : {std::size_t{0}, std::size_t{5}}) {
    const std::string name = fmt::format("o{}.h5", wanted);
    const auto words = on_ranks("3", {"-o", name, "--referee", std::to_string(wanted)});
    REQUIRE(Process(words, folder.path()).wait().exit == 0);
    CHECK(SweepReader(folder / name).verdicts().size() == wanted);
  }
}

}  // namespace wormdrive::test::sweep_ranks
