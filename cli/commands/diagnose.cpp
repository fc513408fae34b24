#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <unistd.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/describe/drive.hpp"
#include "cli/pictures.hpp"
#include "cli/shell_words.hpp"
#include "description/diagnostics.hpp"
#include "description/keys.hpp"
#include "diagnosis/diagnose_files.hpp"
#include "diagnosis/report/diagnosis_folder.hpp"
#include "diagnosis/report/diagnosis_json.hpp"
#include "diagnosis/verdict/certificate.hpp"
#include "simulation/load_scenario.hpp"
#include "statistics/threads.hpp"

namespace wormdrive {
namespace {

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

constexpr std::size_t rows_told = 5;

/// What goes on, on one line of a terminal that the next phrase overwrites.
class Phases {
 public:
  explicit Phases(bool quiet) : wanted_(!quiet && isatty(STDERR_FILENO) != 0) {}
  ~Phases() { tell(""); }
  void tell(const std::string& phase) const {
    if (!wanted_) return;
    fmt::print(stderr, "\r  {:<74.74}{}", phase, phase.empty() ? "\r" : "");
    std::fflush(stderr);
  }

 private:
  bool wanted_;
};

/// "+0.0150 +- 0.0010", in the unit of the edge.
std::string estimate(const EstimatedEffect& effect) {
  if (effect.parameters.empty()) return "";
  const Estimate& e = effect.parameters.front();
  std::string text = fmt::format("{:+.3g}", e.value / e.unit.si);
  if (e.standard_error > 0.0) text += fmt::format(" +- {:.2g}", e.standard_error / e.unit.si);
  return e.unit.suffix.empty() ? text : fmt::format("{} {}", text, e.unit.symbol);
}

void print_ranking(const Diagnosis& d) {
  fmt::print("  {:<20} {:>8} {:>14}   {:<30} {}\n", "effect", "dBIC", "held-out gain", "estimate", "verdict");
  for (std::size_t k = 0; k < std::min(rows_told, d.ranking.size()); ++k) {
    const RankedCandidate& c = d.ranking[k];
    fmt::print("  {:<20} {:>8.0f} {:>14.0f}   {:<30} {}\n", c.effect.effect, c.delta_bic, c.held_out_gain,
               estimate(c.effect), c.named ? c.outcome : "rejected: " + c.outcome);
  }
}

void print_gain(const Diagnosis& d) {
  for (const PredictionError& e : d.prediction) {
    const bool torque = std::isnan(e.horizon);
    print_item("gain", fmt::format("{} on data not used for the fit: {:.3g} -> {:.3g} m{} (95 %: {:.3g} to {:.3g}){}",
                                   torque ? "error of the " + in_words_of(d.extended.axis, "torque")
                                          : fmt::format("error {:g} s ahead", e.horizon),
                                   1e3 * e.before, 1e3 * e.after, e.unit.symbol, 1e3 * e.after_low, 1e3 * e.after_high,
                                   std::isfinite(e.floor) ? fmt::format(", noise floor {:.2g}", 1e3 * e.floor) : ""));
  }
}

/// What these data can never show; what they show only above a size is in the file.
void print_blind_spots(const Diagnosis& d) {
  const std::vector<std::string> unseen = unobservable(d.certificate);
  if (!unseen.empty()) print_item("unseen", fmt::format("{}", fmt::join(unseen, ", ")));
}

/// "+- 0.001", or that the earlier data do not show it.
std::string error_of(const Estimate& e) {
  return std::isfinite(e.standard_error) ? fmt::format("+- {:.2g}", e.standard_error / e.unit.si) : "not shown";
}

void print_changes(const Since& since) {
  constexpr const char* row = "  {:<20} {:<26} {:>10} {:<11} {:>10} {:<11} {:>10} {:<11} {}";
  const auto print_row = [&](const auto&... cells) {
    std::string line = fmt::format(fmt::runtime(row), cells...);
    line.resize(line.find_last_not_of(' ') + 1);
    fmt::print("{}\n", line);
  };
  if (!since.changes.empty()) print_row("effect", "parameter", "before", "", "now", "", "change", "", "");
  for (const Change& c : since.changes) {
    const auto number = [&](const Estimate& e) { return fmt::format("{:.4g}", e.value / e.unit.si); };
    const std::string unit = c.after.unit.suffix.empty() ? "" : fmt::format(" [{}]", c.after.unit.symbol);
    print_row(c.effect, c.after.field + unit, number(c.before), error_of(c.before), number(c.after), error_of(c.after),
              fmt::format("{:+.3g}", c.difference.value / c.difference.unit.si), error_of(c.difference),
              c.certain ? "changed" : "");
  }
}

void print(const Diagnosis& d) {
  fmt::print("{}\n", d.sentence);
  if (d.since) print_changes(*d.since);
  for (const std::string& remark : d.remarks) print_item("data", remark);
  print_ranking(d);
  print_gain(d);
  for (const Estimate& e : d.identified)
    print_item("found", fmt::format("{} = {:.4g} +- {:.2g} (95 %: {:.4g} to {:.4g})", e.field, e.value,
                                    e.standard_error, e.low, e.high));
  print_blind_spots(d);
  if (!d.experiment_reason.empty()) print_item("next", d.experiment_reason);
  std::fflush(stdout);  // pictures take a second
}

/// Draws all pictures of a diagnosis; none, with a word on it, where the program that draws is not there.
std::vector<std::string> draw_pictures(const DiagnosisFolder& folder, int at_a_time, Replace replace) {
  if (draw_all(folder.inside("diagnosis.h5"), folder.path(), at_a_time, replace) != 0) return {};
  std::vector<std::string> pictures;
  for (const char* const part : {"prediction", "residual", "ranking", "certificate"})
    pictures.push_back(folder.inside(std::string(part) + ".png"));
  return pictures;
}

/// Loads of recordings that are not the scenario's, by file.
std::map<std::string, LoadParameters> own_loads(const DiagnoseOptions& options, const Scenario& scenario) {
  std::map<std::string, std::vector<std::string>> overrides;
  std::vector<std::string> files = options.data;
  files.insert(files.end(), options.since.begin(), options.since.end());
  for (const std::string& load : options.loads) {
    const auto file =
        std::find_if(files.begin(), files.end(), [&](const std::string& data) { return load.starts_with(data + ":"); });
    if (file == files.end())
      reject({"--load " + load}, fmt::format("must be FILE:KEY=VALUE of one of the recordings {}, as in {}:mass_kg=0.9",
                                             fmt::join(files, ", "), files.front()));
    if (const DataKind kind = kind_of_data({*file}, scenario); kind != DataKind::recording)
      reject({*file}, fmt::format("holds {}; a load of its own is for a recording over time", name(kind)));
    overrides[*file].push_back("load." + load.substr(file->size() + 1));
  }
  std::map<std::string, LoadParameters> loads;
  for (const auto& [file, keys] : overrides) {
    std::vector<std::string> all = options.scenario.overrides;
    all.insert(all.end(), keys.begin(), keys.end());
    loads[file] = load_scenario(options.scenario.file, all, Purpose::look).load;
  }
  return loads;
}

int diagnose_command(const DiagnoseOptions& options) {
  const Scenario scenario = load_scenario(options.scenario.file, options.scenario.overrides, Purpose::look);
  std::vector<std::string> inputs = options.data;
  inputs.insert(inputs.end(), options.since.begin(), options.since.end());
  inputs.push_back(options.scenario.file);
  const DiagnosisFolder folder(options.output, inputs, options.replace);
  const DataKind kind = kind_of_data(options.data, scenario);
  const std::map<std::string, LoadParameters> loads = own_loads(options, scenario);
  const bool talk = !options.scenario.quiet && !options.scenario.json;
  const int threads = static_cast<int>(threads_for(options.threads));
  const Diagnosis diagnosis = [&] {
    const Phases phases(!talk);
    DiagnosisSettings settings;
    settings.seed = static_cast<std::uint64_t>(options.seed);
    settings.draws = static_cast<int>(options.draws);
    settings.threads = threads;
    settings.progress = [&](const std::string& phase) { phases.tell(phase); };
    return options.since.empty() ? diagnose_files(scenario, kind, options.data, settings, loads)
                                 : diagnose_since(scenario, options.since, kind, options.data, settings, loads);
  }();

  if (talk) print(diagnosis);
  const nlohmann::json json = as_json(diagnosis, name(kind), options.data);
  const std::vector<std::string> written = folder.write(
      diagnosis, json, scenario.title, options.scenario.command_line,
      [&] { return options.pictures ? draw_pictures(folder, threads, options.replace) : std::vector<std::string>{}; });
  if (options.scenario.json) print_json(json);
  if (talk)
    print_item("wrote",
               fmt::format("{}    see it: wormdrive report {}", fmt::join(written, ", "), shell_path(folder.path())));
  return 0;
}

}  // namespace

void add_diagnose(CommandSet& commands) {
  auto [command, options] =
      commands.add("diagnose", "find the effects that a scenario lacks to predict measured data", diagnose_command);
  add_scenario_options(command, options.scenario);
  command
      .add_option(
          "data", options.data,
          "recordings over time, records at constant speed or a break-in table (.csv, .mat, .h5), recognised by "
          "their columns; several files of one kind are diagnosed together")
      ->required();
  add_repeated(command, "--since", options.since, "FILE",
               "data of the same drive from before: what has changed since then; may be repeated");
  add_repeated(command, "--load", options.loads, "FILE:KEY=VALUE",
               "load of a recording if it is not that of the scenario: --load heavy.csv:mass_kg=0.9; may be repeated");
  command.add_option("-o,--output", options.output, "folder for the results")->required();
  command.add_option("--seed", options.seed, "seed of the bootstrap")
      ->check(CLI::Range(0.0, 9007199254740992.0, "NOT NEGATIVE"))
      ->capture_default_str();
  command
      .add_option("--draws", options.draws,
                  "fit a recording anew so many times, with its blocks weighted at random, so that uncertainty.toml "
                  "draws these fits instead of a normal distribution")
      ->check(CLI::Range(10U, 1000000U, "10 TO 1000000"));
  add_threads(command, options.threads);
  command.add_flag_callback(
      "--no-pictures", [&chosen = options] { chosen.pictures = false; }, "do not draw pictures");
  add_force(command, options.replace);
}

}  // namespace wormdrive
