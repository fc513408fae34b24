#include "cli/pictures.hpp"

#include <cstring>

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include "output/hdf5/hdf5.hpp"
#include "output/resource.hpp"

extern char** environ;

namespace wormdrive {

int run_plots(const std::vector<std::string>& arguments) {
  // -B: no __pycache__ beside the scripts, which a package would leave behind
  std::vector<std::string> words{WORMDRIVE_PYTHON, "-B", resource("share/wormdrive/plots/plot.py")};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  if (const int error = posix_spawnp(&child, argv[0], nullptr, nullptr, argv.data(), environ); error != 0)
    throw OutputFault(fmt::format("cannot start {}: {}", words[0], std::strerror(error)));
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

int draw_all(const std::string& file, const std::string& folder, int at_a_time, Replace replace) {
  std::vector<std::string> words{"--output=" + folder, "--part", "all", "--at-a-time", fmt::format("{}", at_a_time)};
  if (replace == Replace::anything) words.emplace_back("--force");
  words.insert(words.end(), {"--", file});
  return run_plots(words);
}

}  // namespace wormdrive
