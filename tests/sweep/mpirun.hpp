#pragma once
// What the tests of ranks share.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <string>
#include <unistd.h>
#include <vector>

namespace wormdrive::test {

inline const std::string mpirun = WORMDRIVE_MPIRUN;

/// Whether the program knows MPI; else there is nothing to test.
inline bool has_mpi() {
  if (mpirun.empty()) std::cout << "skipped: built without MPI\n";
  std::ifstream variables(WORMDRIVE_TESTS "/sweep/mpirun.env");
  for (std::string line; std::getline(variables, line);)
    if (const std::size_t at = line.find('='); at != std::string::npos)
      setenv(line.substr(0, at).c_str(), line.c_str() + at + 1, 1);
  return !mpirun.empty();
}

/// `wormdrive sweep study.toml` on so many ranks of one thread each.
inline std::vector<std::string> on_ranks(const char* count, std::vector<std::string> words) {
  words.insert(words.begin(), {mpirun, "-n", count, WORMDRIVE_PROGRAM, "sweep", "study.toml", "--threads", "1"});
  return words;
}

/// The processes that a process has started.
inline std::vector<pid_t> children(pid_t parent) {
  std::vector<pid_t> list;
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream stat(entry.path() / "stat");
    std::string pid, name, state, of;
    if (stat >> pid >> name >> state >> of && of == std::to_string(parent)) list.push_back(std::stoi(pid));
  }
  return list;
}

/// Kills the last rank of the one job that runs; false where there is none.
inline bool lose_a_rank() {
  const std::vector<pid_t> mpiruns = children(getpid());
  if (mpiruns.size() != 1) return false;
  const std::vector<pid_t> ranks = children(mpiruns.front());
  return ranks.size() > 1 && ::kill(ranks.back(), SIGKILL) == 0;
}

}  // namespace wormdrive::test
