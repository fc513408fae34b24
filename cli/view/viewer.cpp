#include "cli/view/viewer.hpp"

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include <fmt/format.h>

#include "cli/report/kinds.hpp"
#include "cli/run_and_write.hpp"
#include "cli/shell_words.hpp"
#include "description/diagnostics.hpp"
#include "description/toml/write_scenario.hpp"
#include "output/hdf5/hdf5.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/write_run.hpp"

namespace wormdrive {
namespace {

/// A new folder that nobody else may look into, in memory where the system offers that: a disk takes longer than a run.
std::filesystem::path private_folder() {
  const char* const of_user = std::getenv("XDG_RUNTIME_DIR");
  const std::filesystem::path on_disk = std::filesystem::temp_directory_path();
  for (const std::filesystem::path& place : {std::filesystem::path(of_user ? of_user : ""), {"/dev/shm"}, on_disk}) {
    std::string name = (place / "wormdrive-view-XXXXXX").string();
    if (!place.empty() && mkdtemp(name.data())) return name;
  }
  throw OutputFault(
      fmt::format("{}: no folder can be made there: {}", on_disk.string(), std::generic_category().message(errno)));
}

std::string assignment(const std::string& key, double value) { return fmt::format("{}={}", key, value); }

}  // namespace

Viewer::Viewer(std::string file, std::vector<std::string> overrides, const std::vector<std::string>& vary)
    : file_(std::move(file)), overrides_(std::move(overrides)) {
  const Scenario scenario = load_scenario(file_, overrides_, Purpose::run);
  sliders_ = wormdrive::sliders(scenario, vary, [&](const std::string& key, double value) {
    std::vector<std::string> tried = overrides_;
    tried.push_back(assignment(key, value));
    try {
      load_scenario(file_, tried, Purpose::run);
      return true;
    } catch (const InputFault&) {
      return false;
    }
  });
  folder_ = private_folder();
}

Viewer::~Viewer() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

ReportPage Viewer::page(const std::map<std::string, double>& values) {
  const unsigned mine = ++newest_;
  const std::scoped_lock alone(running_);
  std::vector<std::string> chosen = overrides_;
  std::string command = "wormdrive run " + shell_path(file_);
  for (const auto& [key, value] : values) chosen.push_back(assignment(key, value));
  for (const std::string& one : chosen) command += " --set " + shell_word(one);
  const Scenario scenario = load_scenario(file_, chosen, Purpose::run);
  const std::string path = folder_ / "run.h5";
  std::filesystem::remove(path);
  RunFile run(path, {"run", scenario.title, to_toml(scenario), command}, scenario.axis, contents_of(scenario),
              Replace::anything);
  run_into(run, scenario, {.time = [&](double) {
             if (newest_ != mine) throw Superseded();
           }});
  return whole_page(ResultFile(path, Writer::this_program));
}

}  // namespace wormdrive
