#pragma once
// What the tests of ranks share.
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
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

}  // namespace wormdrive::test
