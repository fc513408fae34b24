#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "output/replacing.hpp"

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
  Replace replace = Replace::same_kind;
};
int run_command(const RunOptions& options);

int check_command(const ScenarioOptions& options);

struct StaticsOptions {
  ScenarioOptions scenario;
  std::string output;
  std::optional<double> max_load;  ///< [N m]
  int points = 41;
  Replace replace = Replace::same_kind;
};
int statics_command(const StaticsOptions& options);

struct SteadyOptions {
  ScenarioOptions scenario;
  std::string output;
  std::string data;                 ///< CSV of records at constant speed
  std::optional<double> max_speed;  ///< worm speed [rad/s]
  int points = 41;
  Replace replace = Replace::same_kind;
};
int steady_command(const SteadyOptions& options);

struct EfficiencyOptions {
  ScenarioOptions scenario;
  std::string output;
  std::optional<double> max_speed;  ///< worm speed [rad/s]
  std::optional<double> max_load;   ///< [N m]
  int points = 20;
  Replace replace = Replace::same_kind;
};
int efficiency_command(const EfficiencyOptions& options);

struct DiagnoseOptions {
  ScenarioOptions scenario;
  std::vector<std::string> data;   ///< CSV, or results of run
  std::vector<std::string> since;  ///< data of the same drive before something changed
  std::vector<std::string> loads;  ///< "file:key=value"
  std::string output;              ///< folder
  double seed = 1;                 ///< of bootstraps
  unsigned draws = 0;              ///< from what the data leave open; 0: that is taken for normal
  unsigned threads = 0;            ///< 0: as many as the machine has
  bool pictures = true;
  Replace replace = Replace::same_kind;
};
int diagnose_command(const DiagnoseOptions& options);

struct ViewOptions {
  ScenarioOptions scenario;
  std::vector<std::string> vary;  ///< "table.key" or "table.key=low..high"; empty: all numbers
  int port = 0;                   ///< 0: any that is free
};
int view_command(const ViewOptions& options);

struct PlotOptions {
  std::vector<std::string> files;  ///< one, or several that share a picture
  std::string output;              ///< empty: named after the first file
  std::string over;                ///< what runs are drawn over instead of time
  std::string part = {};           ///< which picture of a diagnosis
  Replace replace = Replace::same_kind;
};
int plot_command(const PlotOptions& options);
/// Draws files into a picture; the exit code of the program that draws.
int draw(const PlotOptions& options);
/// Draws every picture of a diagnosis into a folder, PART.png, some at a time; the exit code likewise.
int draw_all(const std::string& file, const std::string& folder, int at_a_time, Replace replace);

struct SweepOptions {
  std::string study;
  std::string output;    ///< empty: named after the study
  unsigned threads = 0;  ///< 0: as many as the machine has
  std::string shard;     ///< "i/n"; empty: all trials
  std::optional<std::uint64_t> max_failures;
  std::optional<std::uint64_t> referee;  ///< trials that CVODE judges; else what fits into 5 % of the time
  bool resume = false;
  bool quiet = false;
  Replace replace = Replace::same_kind;
  std::string command_line;
};
int sweep_command(const SweepOptions& options);

struct MergeOptions {
  std::vector<std::string> shards;
  std::string output;
  Replace replace = Replace::same_kind;
  bool quiet = false;
  std::string command_line;
};
int merge_command(const MergeOptions& options);

struct ReplayOptions {
  std::string sweep;
  std::uint64_t trial = 0;
  std::string output;
  Replace replace = Replace::same_kind;
  bool quiet = false;
  std::string command_line;
};
int replay_command(const ReplayOptions& options);

struct SummaryOptions {
  std::string sweep;
  std::string metric;  ///< by which trials are ranked; empty: that of the first threshold, else the first with a unit
  unsigned worst = 5;  ///< trials shown
  bool done_only = false;  ///< leave out refused and halted trials
  bool json = false;
};
int summary_command(const SummaryOptions& options);

struct WorstOptions {
  std::string sweep;
  std::string metric;  ///< empty: the one by which trials are ranked
  std::uint64_t evaluations = 400;
  double tail = 1e-3;      ///< probability left out at either end of each parameter
  bool done_only = false;  ///< look among drives alone that run to the end
  Replace replace = Replace::same_kind;
  unsigned threads = 0;
  std::string output;
  bool quiet = false;
  std::string command_line;
};
int worst_command(const WorstOptions& options);

struct RareOptions {
  std::string study;
  std::string metric;              ///< of the limit; empty: of the first one
  std::uint64_t per_level = 2000;  ///< points of a level of the subset simulation
  std::uint64_t samples = 2000;    ///< around the design point
  std::string output;              ///< empty: none
  std::string command_line;        ///< as typed
  unsigned threads = 0;
  bool json = false;
  bool resume = false;
  Replace replace = Replace::same_kind;
};
int rare_command(const RareOptions& options);

struct FmuOptions {
  ScenarioOptions scenario;
  int version = 2;             ///< of the standard, 2 or 3
  std::string kind = "plant";  ///< or "loop"
  std::string output;          ///< empty: named after the scenario
  Replace replace = Replace::same_kind;
};
int fmu_command(const FmuOptions& options);

struct ListOptions {
  std::string topic;
};
int list_command(const ListOptions& options);

struct SchemaOptions {
  std::string kind = "scenario";  ///< or "study"
};
/// Prints the JSON schema of scenarios or of studies.
int schema_command(const SchemaOptions& options);

struct NewOptions {
  std::string file;
  std::string kind;  ///< one of new_kinds()
};
/// What `wormdrive new --kind` may be.
std::vector<std::string> new_kinds();
int new_command(const NewOptions& options);

struct DiffOptions {
  std::string first, second;
  double relative = 1e-6;  ///< difference allowed, as a share of the signal's largest magnitude
  double absolute = 0.0;   ///< difference allowed, in the signal's units
  double time = 1e-6;      ///< difference of event times allowed [s]
  bool quiet = false;
  bool json = false;
};
/// 0 where two results agree, 1 where they differ.
int diff_command(const DiffOptions& options);

struct ReportOptions {
  std::string file;
  std::string output;  ///< empty: named after the file
  Replace replace = Replace::same_kind;
};
int report_command(const ReportOptions& options);

struct ExportOptions {
  std::string file;               ///< result of a run or of a sweep
  bool csv = false, mat = false;  ///< of a run: one of them
  std::string what = "trials";    ///< of a sweep: or "summary"
  std::string output;             ///< empty: named after the run; of a sweep standard output
  std::string metric;             ///< of the summary, as there
  bool done_only = false;
  bool quiet = false;
  Replace replace = Replace::same_kind;
};
int export_command(const ExportOptions& options);
/// Writes a table of a sweep as CSV.
int export_sweep(const ExportOptions& options);

}  // namespace wormdrive
