#include <cstring>
#include <filesystem>

#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include "cli/commands.hpp"
#include "cli/describe/drive.hpp"
#include "cli/report/result_file.hpp"
#include "output/resource.hpp"

extern char** environ;

namespace wormdrive {
namespace {

/// The picture that is written.
std::string picture(const PlotOptions& options) {
  return options.output.empty() ? std::filesystem::path(options.files.front()).replace_extension(".png").string()
                                : options.output;
}

/// Runs the script that draws; its exit code.
int run_script(const std::vector<std::string>& arguments) {
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

}  // namespace

int plot_command(const PlotOptions& options) {
  open_results(options.files);  // refuses what is no result, or a damaged one
  const int code = draw(options);
  if (code == 0) print_item("wrote", picture(options));
  return code;
}

int draw(const PlotOptions& options) {
  std::vector<std::string> words{"--output=" + picture(options)};
  if (!options.part.empty()) words.insert(words.end(), {"--part", options.part});
  if (!options.over.empty()) words.insert(words.end(), {"--over", options.over});
  if (options.replace == Replace::anything) words.emplace_back("--force");
  words.emplace_back("--");  // a file may be called like an option
  words.insert(words.end(), options.files.begin(), options.files.end());
  return run_script(words);
}

int draw_all(const std::string& file, const std::string& folder, int at_a_time, Replace replace) {
  std::vector<std::string> words{"--output=" + folder, "--part", "all", "--at-a-time", fmt::format("{}", at_a_time)};
  if (replace == Replace::anything) words.emplace_back("--force");
  words.insert(words.end(), {"--", file});
  return run_script(words);
}

}  // namespace wormdrive
