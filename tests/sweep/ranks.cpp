// Ranks that share a sweep make the rows that one process makes, also when one of them is lost.
#include <cstdlib>
#include <iostream>
#include <unistd.h>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>

#include "catch.hpp"
#include "sweep/studies.hpp"

namespace wormdrive::test::sweep_ranks {

namespace {

const std::string mpirun = WORMDRIVE_MPIRUN;

/// Whether the program knows MPI; else there is nothing to test.
bool has_mpi() {
  if (mpirun.empty()) std::cout << "skipped: built without MPI\n";
  setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
  setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
  setenv("OMPI_MCA_rmaps_base_oversubscribe", "1", 1);
  return !mpirun.empty();
}

std::vector<std::string> on_ranks(const char* count, std::vector<std::string> words) {
  words.insert(words.begin(), {mpirun, "-n", count, WORMDRIVE_PROGRAM, "sweep", "study.toml", "--threads", "1"});
  return words;
}

/// The processes that a process has started.
std::vector<pid_t> children(pid_t parent) {
  std::vector<pid_t> list;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream stat(entry.path() / "stat");
    std::string pid, name, state, of;
    if (stat >> pid >> name >> state >> of && of == std::to_string(parent)) list.push_back(std::stoi(pid));
  }
  return list;
}

}  // namespace

TEST_CASE("1, 2 and 4 ranks make the rows of one process", "[sweep]") {
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

TEST_CASE("a lost rank costs its last trials, which any number of ranks makes up for", "[sweep]") {
  if (!has_mpi()) return;
  const StudyFolder folder(study_but("trials = 200", "trials = 100000"));
  REQUIRE(folder.sweep({"-o", "alone.h5"}).exit == 0);
  // room that the second rank's file takes on the disk: rows take some, their place from the start takes none
  const auto room = [&] {
    struct stat file {};
    return stat((folder / "ranks.h5.rank_1_1.part").c_str(), &file) == 0 ? file.st_blocks : 0;
  };
  Process job(on_ranks("2", {"-o", "ranks.h5"}), folder.path());
  while (room() == 0) usleep(1000);
  for (const auto empty = room(); room() == empty;) usleep(1000);
  const std::vector<pid_t> mpiruns = children(getpid());
  REQUIRE(mpiruns.size() == 1);
  const std::vector<pid_t> ranks = children(mpiruns.front());
  REQUIRE(ranks.size() == 2);
  ::kill(ranks.back(), SIGKILL);
  CHECK(job.wait().exit != 0);
  CHECK_FALSE(folder.names().contains("ranks.h5"));
  std::size_t kept = 0;
  for (const std::string& name : folder.names())
    if (name.starts_with("ranks.h5.rank_")) {
      const int part = open((folder / name).c_str(), O_RDONLY);
      REQUIRE(flock(part, LOCK_SH) == 0);  // waits: the other rank may outlive mpirun for a moment
      close(part);
      kept += folder.present(name);
    }
  CHECK(kept > 0);

  const Outcome anew = Process(on_ranks("2", {"-o", "ranks.h5"}), folder.path()).wait();
  CHECK(anew.exit == 2);
  CHECK(anew.err.find("of 100000 trials of an interrupted sweep; add --resume to go on") != std::string::npos);

  SECTION("of four ranks") {
    const Outcome outcome = Process(on_ranks("4", {"-o", "ranks.h5", "--resume"}), folder.path()).wait();
    INFO(outcome.err);
    REQUIRE(outcome.exit == 0);
    CHECK(outcome.out.find(" were there already") != std::string::npos);
  }
  SECTION("or a single process") {
    const Outcome outcome = folder.sweep({"-o", "ranks.h5", "--resume"});
    INFO(outcome.err);
    REQUIRE(outcome.exit == 0);
    CHECK(outcome.out.find(" were there already") != std::string::npos);
  }
  CHECK(folder.rows("ranks.h5") == folder.rows("alone.h5"));
  CHECK(folder.names() == std::set<std::string>{"s.toml", "study.toml", "alone.h5", "ranks.h5"});
}

TEST_CASE("what a single process has left, ranks go on with", "[sweep]") {
  if (!has_mpi()) return;
  const StudyFolder folder(study_but("trials = 200", "trials = 60000"));
  REQUIRE(folder.sweep({"-o", "alone.h5"}).exit == 0);
  REQUIRE(folder.interrupted({"-o", "ranks.h5"}, SIGINT).exit == 128 + SIGINT);
  const Outcome outcome = Process(on_ranks("2", {"-o", "ranks.h5", "--resume"}), folder.path()).wait();
  INFO(outcome.err);
  REQUIRE(outcome.exit == 0);
  CHECK(folder.rows("ranks.h5") == folder.rows("alone.h5"));
}

TEST_CASE("ranks end for as many failures, and say so in the words, of a single process", "[sweep]") {
  if (!has_mpi()) return;
  const StudyFolder folder(edited(lanes_study, "trials = 200", "trials = 4000"));
  const auto told = [](const std::string& said) {  // "11 of 432 trials failed, ...; most often: ..."
    const std::size_t begin = said.find("wormdrive: ");
    return said.substr(begin, said.find("; ", said.find("most often")) - begin);
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

TEST_CASE("bad input on ranks is told once", "[sweep]") {
  if (!has_mpi()) return;
  const StudyFolder folder(study_but("trials = 200", "trials = 0"));
  const Outcome outcome = Process(on_ranks("2", {"-o", "ranks.h5"}), folder.path()).wait();
  CHECK(outcome.exit == 2);
  const std::string message = "study.toml:6:10: error: sweep.trials = 0 must be at least 1 and at most 1e+12\n";
  CHECK(outcome.err.find(message) != std::string::npos);
  CHECK(outcome.err.find(message) == outcome.err.rfind(message));
}

}  // namespace wormdrive::test::sweep_ranks
