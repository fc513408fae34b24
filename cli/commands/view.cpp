#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/describe/drive.hpp"
#include "cli/view/server.hpp"

namespace wormdrive {
namespace {

struct ViewOptions {
  ScenarioOptions scenario;
  std::vector<std::string> vary;  ///< "table.key" or "table.key=low..high"; empty: all numbers
  int port = 0;                   ///< 0: any that is free
};

int view_command(const ViewOptions& options) {
  Viewer viewer(options.scenario.file, options.scenario.overrides, options.vary);
  serve(viewer, options.port, [&](const std::string& address) {
    if (options.scenario.json) {
      print_json(nlohmann::json{{"address", address}});
    } else {
      print_item("view", fmt::format("{}    open it in a browser; Ctrl-C ends it", address));
    }
    std::fflush(stdout);
  });
  return 0;
}

}  // namespace

void add_view(CommandSet& commands) {
  auto [command, options] =
      commands.add("view", "look at a scenario in a browser, with sliders that run it again", view_command);
  add_scenario_options(command, options.scenario);
  command.add_option(
      "--vary", options.vary,
      "a number with a slider: table.key or table.key=low..high; default: all numbers, from half to twice");
  command.add_option("--port", options.port, "port of the loopback address; 0: any that is free")
      ->check(CLI::Range(0, 65535))
      ->capture_default_str();
}

}  // namespace wormdrive
