#include <filesystem>

#include <fmt/format.h>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/describe/drive.hpp"
#include "cli/pictures.hpp"
#include "cli/report/result_file.hpp"

namespace wormdrive {
namespace {

struct PlotOptions {
  std::vector<std::string> files;  ///< one, or several that share a picture
  std::string output;              ///< empty: named after the first file
  std::string over;                ///< what runs are drawn over instead of time
  std::string part = {};           ///< which picture of a diagnosis
  Replace replace = Replace::same_kind;
};

/// The picture that is written.
std::string picture(const PlotOptions& options) {
  return options.output.empty() ? std::filesystem::path(options.files.front()).replace_extension(".png").string()
                                : options.output;
}

/// Draws files into a picture; the exit code of the program that draws.
int draw(const PlotOptions& options) {
  std::vector<std::string> words{"--output=" + picture(options)};
  if (!options.part.empty()) words.insert(words.end(), {"--part", options.part});
  if (!options.over.empty()) words.insert(words.end(), {"--over", options.over});
  if (options.replace == Replace::anything) words.emplace_back("--force");
  words.emplace_back("--");  // a file may be called like an option
  words.insert(words.end(), options.files.begin(), options.files.end());
  return run_plots(words);
}

int plot_command(const PlotOptions& options) {
  open_results(options.files);  // refuses what is no result, or a damaged one
  const int code = draw(options);
  if (code == 0) print_item("wrote", picture(options));
  return code;
}

}  // namespace

void add_plot(CommandSet& commands) {
  auto [command, options] = commands.add("plot", "draw a result as a picture (PNG)", plot_command);
  command
      .add_option(
          "files", options.files,
          "results (.h5); one picture shows a statics result with the break-aways of runs, a sweep with runs of "
          "its trials, or several runs over the motor torque")
      ->required();
  command.add_option("--over", options.over, "draw runs over the motor torque instead of time")
      ->check(CLI::IsMember({"motor_torque"}));
  command.add_option("--part", options.part, "which picture of a diagnosis; default: prediction")
      ->check(CLI::IsMember({"prediction", "residual", "ranking", "certificate"}));
  command.add_option("-o,--output", options.output, "picture; default: the result's name with .png");
  add_force(command, options.replace);
}

}  // namespace wormdrive
