#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/commands.hpp"
#include "cli/describe/drive.hpp"
#include "cli/view/server.hpp"

namespace wormdrive {

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

}  // namespace wormdrive
