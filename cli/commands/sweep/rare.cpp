#include "cli/describe/rare.hpp"

#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/commands/sweep/sweep_steps.hpp"
#include "cli/describe/drive.hpp"
#include "cli/describe/sweep.hpp"
#include "description/diagnostics.hpp"
#include "output/replacing.hpp"
#include "simulation/overwriting.hpp"
#include "statistics/normal.hpp"
#include "statistics/threads.hpp"
#include "sweep/rare/rare_file.hpp"
#include "sweep/study/load_study.hpp"

namespace wormdrive {
namespace {

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

nlohmann::ordered_json as_json(const RareEstimate& p) {
  return {{"probability", p.probability},
          {"low", p.low},
          {"high", p.high},
          {"variation", p.variation},
          {"evaluations", p.evaluations}};
}

nlohmann::ordered_json as_json(const RareEvent& event, const Study& study) {
  nlohmann::ordered_json made{{"title", study.title},
                              {"metric", event.threshold.metric},
                              {event.threshold.above ? "above" : "below", event.threshold.limit},
                              {"unit", study.metric(event.threshold.metric).unit.symbol},
                              {"subset_simulation", as_json(event.subset.estimate)},
                              {"levels", nlohmann::ordered_json::array()},
                              {"plain_trials", event.plain_trials()},
                              {"median_misses", event.median_misses}};
  for (const SubsetLevel& level : event.subset.levels)
    made["levels"].push_back({{"distance", level.threshold}, {"share", level.share}, {"acceptance", level.acceptance}});
  if (event.median_misses) return made;
  made["beta"] = event.design.beta;
  made["converged"] = event.design.converged;
  for (std::size_t k = 0; k < study.parameters.size(); ++k)
    made["design_point"][study.parameters[k].name] = {
        {"value", event.likely.parameters[k]},
        {"unit", study.parameters[k].si_unit.symbol},
        {"importance", event.design.direction.empty() ? 0.0 : event.design.direction[k] * event.design.direction[k]}};
  made["importance_sampling"] = as_json(event.importance);
  made["agrees"] = event.agrees();
  return made;
}

/// The drive that misses most likely, and what each parameter has to do with it.
void print_design_point(const RareEvent& event, const Study& study) {
  print_item("design",
             fmt::format("beta {:.4g}, FORM {:.3g}{}", event.design.beta, normal_probability(-event.design.beta),
                         event.design.converged ? "" : "; the search has not converged"));
  for (std::size_t k = 0; k < study.parameters.size(); ++k)
    print_item(
        k == 0 ? "with" : "",
        fmt::format(
            "{} {:.6g}{}{}", study.parameters[k].name, event.likely.parameters[k], in_unit(study.parameters[k].si_unit),
            event.design.direction.empty()
                ? ""
                : fmt::format(", importance {:.0f} %", 100.0 * event.design.direction[k] * event.design.direction[k])));
}

int rare_command(const RareOptions& options) {
  const Study study = load_study(options.study);
  RareSettings settings{limit_of(study, options.study, options.metric).metric, options.per_level, options.samples,
                        threads_for(options.threads)};
  std::optional<RareFile> file;
  if (options.resume && options.output.empty()) reject({options.study}, "cannot be resumed without --output");
  if (!options.output.empty()) {
    for (const std::string& input : {options.study, study.scenario_file}) reject_overwriting(options.output, input);
    file.emplace(followed(options.output), study, settings, options.command_line, options.resume, options.replace);
    settings.kept = file->runs();
  }
  const RareEvent event = [&] {
    try {
      RareEvent made = estimate_rare_event(study, options.study, settings);
      if (file) file->finish(made);
      return made;
    } catch (const ReadFault&) {  // which room on the disk would not mend
      throw;
    } catch (const InputFault&) {
      if (file) file->give_up();
      throw;
    } catch (const OutputFault& fault) {
      throw OutputFault(fmt::format("{}; runs older than a second are safe; free some space, then {}", fault.what(),
                                    how_to_resume(options.command_line, options.resume)));
    }
  }();
  if (options.json) {
    fmt::print("{}\n", as_json(event, study).dump(2));
    return 0;
  }
  if (file && file->from_before() > 0)
    print_item("resume", file->was_complete() ? fmt::format("{} already contains every run", options.output)
                                              : fmt::format("{} runs were already made", file->from_before()));
  const Threshold& limit = event.threshold;
  const RareEstimate& p = event.subset.estimate;
  fmt::print("{}\n", study.title);
  print_item("limit", fmt::format("{} at {} {:g}{}", limit.metric, limit.above ? "most" : "least", limit.limit,
                                  in_unit(study.metric(limit.metric).unit)));
  print_item("subset", fmt::format("missed with probability {}, {} levels, {} runs", in_words(p),
                                   event.subset.levels.size(), p.evaluations));
  if (p.variation > 0.0)
    print_item("plain", fmt::format("sampling would take {:.2g} trials for this interval", event.plain_trials()));
  if (event.median_misses) {
    print_item("design", verdict_on(event));
  } else {
    print_design_point(event, study);
    print_item("around", fmt::format("missed with probability {} by {} samples around the design point",
                                     in_words(event.importance), event.importance.evaluations));
    print_item("check", verdict_on(event));
  }
  if (file && !file->was_complete()) print_item("wrote", options.output);
  return 0;
}

}  // namespace

void add_rare(CommandSet& commands) {
  auto [command, options] =
      commands.add("rare", "estimate how rarely the drives of a study miss a limit, down to 1e-9", rare_command);
  command.add_option("study", options.study, "study (.toml); its design does not matter")->required();
  command.add_option("--metric", options.metric, "metric of the limit; default: that of the first [[threshold]]");
  command.add_option("--per-level", options.per_level, "runs of each level of the subset simulation")
      ->check(CLI::Range(100, 1000000))
      ->capture_default_str();
  command.add_option("--samples", options.samples, "runs around the design point")
      ->check(CLI::Range(100, 10000000))
      ->capture_default_str();
  command.add_option("-o,--output", options.output, "result file; without it nothing is kept");
  command.add_flag("--resume", options.resume, "continue an interrupted estimate: only the missing runs are made");
  add_force(command, options.replace);
  add_threads(command, options.threads);
  add_json(command, options.json);
}

}  // namespace wormdrive
