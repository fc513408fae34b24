#pragma once
#include <optional>
#include <string>
#include <vector>

namespace wormdrive {

/// Options that every command which reads a scenario shares.
struct ScenarioOptions {
  std::string file;
  std::vector<std::string> overrides;  ///< --set table.key=value
  bool quiet = false;
  bool json = false;
  std::string command_line;  ///< as typed, for the result file
};

struct RunOptions {
  ScenarioOptions scenario;
  std::string output;  ///< empty: named after the scenario
  bool audit = false;
};
int run_command(const RunOptions& options);

int check_command(const ScenarioOptions& options);

struct StaticsOptions {
  ScenarioOptions scenario;
  std::string output;
  std::optional<double> max_load;  ///< [N m]
  int points = 41;
};
int statics_command(const StaticsOptions& options);

struct SteadyOptions {
  ScenarioOptions scenario;
  std::string output;
  std::string data;                 ///< CSV of records at constant speed
  std::optional<double> max_speed;  ///< worm speed [rad/s]
  int points = 41;
};
int steady_command(const SteadyOptions& options);

struct PlotOptions {
  std::vector<std::string> files;  ///< one, or several that share a picture
  std::string output;              ///< empty: named after the first file
  std::string over;                ///< what runs are drawn over instead of time
};
int plot_command(const PlotOptions& options);

struct FmuOptions {
  ScenarioOptions scenario;
  std::string output;  ///< empty: named after the scenario
};
int fmu_command(const FmuOptions& options);

int list_command(const std::string& what);

}  // namespace wormdrive
