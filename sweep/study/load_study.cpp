#include "sweep/study/load_study.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <locale>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "description/one_line.hpp"
#include "description/toml/document.hpp"
#include "description/toml/table_reader.hpp"
#include "output/resource.hpp"
#include "simulation/load_scenario.hpp"
#include "sweep/metrics/read_metrics.hpp"
#include "sweep/study/read_design.hpp"
#include "sweep/study/read_parameters.hpp"
#include "sweep/study/variable.hpp"

namespace wormdrive {
namespace {

/// An override of the scenario and where the study states it.
struct Setting {
  std::string assignment;  ///< "path=value"
  Location where;
};
using ScenarioSource = std::function<Scenario(const std::vector<Setting>&)>;

class StudyReader {
 public:
  StudyReader(const toml::table& root, const std::string& name, Diagnostics& faults, DataColumns& data)
      : name_(name),
        root_(&root, "", Axis::rotary, faults, {name}),
        faults_(faults),
        data_(data),
        in_table_(root["sweep"]["design"].value<std::string>() == TableOfPoints::kind) {
    root_.set_whole("the study");
  }

  /// source: gives the scenario with what the study makes of it.
  Study read(const ScenarioSource& source) {
    study_.title = root_.line("title").value_or(one_line(std::filesystem::path(name_).stem().string()));
    root_.required_text("scenario", "the file of the scenario, relative to the folder of the study");
    for (const std::string& assignment : root_.texts("set")) settings_.push_back({assignment, root_.where("set")});
    root_.table("data");
    stated_ = read_parameters(root_, data_, in_table_);
    for (const StatedParameter& stated : stated_) study_.parameters.push_back(stated.parameter);
    study_.copula = read_correlations(root_, stated_);
    root_.section("sweep", [&](TableReader& table) { read_design(table, study_, stated_, data_); });
    for (std::size_t k = 0; in_table_ && k < stated_.size(); ++k) stated_[k].parameter = study_.parameters[k];
    if (!root_.has("sweep")) root_.lacks("a [sweep] table with design and trials");
    if (faults_.empty()) {  // only then can the scenario be judged
      read_scenario(source);
      read_metrics();
      check_kept();
      read_thresholds();
    } else {
      root_.texts("metrics");
      root_.tables("metric");
      root_.tables("threshold");
    }
    root_.finish();
    return std::move(study_);
  }

 private:
  static Setting setting(const StatedParameter& stated, double value) {
    return {fmt::format("{}={}", stated.parameter.path, value), stated.where};
  }

  void read_scenario(const ScenarioSource& source) {
    for (const StatedParameter& stated : stated_)
      settings_.push_back(setting(stated, quantile(stated.parameter.distribution, 0.5)));
    study_.scenario = source(settings_);
    const std::vector<Variable> all = variables(study_.scenario);
    std::vector<std::pair<decltype(Variable::place), std::string>> taken;
    for (std::size_t k = 0; k < stated_.size(); ++k) {
      UncertainParameter& parameter = study_.parameters[k];
      const auto found =
          std::find_if(all.begin(), all.end(), [&](const Variable& v) { return v.spelling.key == parameter.path; });
      if (found == all.end()) {
        faults_.add(stated_[k].where,
                    fmt::format("'{}' is not a number of the scenario that a sweep can vary", parameter.path));
        continue;
      }
      parameter.name = found->name;
      parameter.si_unit = found->si_unit();
      for (const auto& [place, path] : taken)
        if (place == found->place)
          faults_.add(stated_[k].where,
                      fmt::format("'{}' is the same number as '{}'; keep one of them", parameter.path, path));
      taken.emplace_back(found->place, parameter.path);
      if (found->spelling.unit.whole) reject_broken_numbers(stated_[k]);
    }
    faults_.raise();
  }

  void reject_broken_numbers(const StatedParameter& stated) {
    if (only_whole_numbers(stated.parameter.distribution)) return;
    faults_.add(stated.where, fmt::format("{} {}; {}", stated.parameter.path, must_be_whole,
                                          in_table_ ? "the column of the table must hold whole values"
                                                    : "use \"discrete\" with whole values"));
  }

  void read_metrics() {
    std::vector<Metric> all = metrics_of(study_.scenario);
    std::vector<std::string> names;
    for (const Metric& metric : all) names.push_back(metric.name);
    study_.own_metrics = read_own_metrics(root_, study_.scenario, names);
    own_are_sound_ = faults_.empty();
    for (const OwnMetric& own : study_.own_metrics) names.push_back(own.name);
    const std::vector<std::string> wanted = root_.texts("metrics");
    for (const std::string& name : wanted)
      if (std::find(names.begin(), names.end(), name) == names.end())
        root_.fault("metrics", fmt::format("there is no metric '{}'; {}", name, suggestion(name, names)));
    if (root_.has("metrics") && faults_.empty())
      std::erase_if(all,
                    [&](const Metric& m) { return std::find(wanted.begin(), wanted.end(), m.name) == wanted.end(); });
    for (std::size_t k = 0; faults_.empty() && k < study_.own_metrics.size(); ++k)
      all.push_back(as_metric(study_.own_metrics, k));
    if (all.empty() && faults_.empty()) root_.fault("metrics", "metrics must name at least one metric");
    study_.metrics = std::move(all);
  }

  /// Whether it is the name of an own metric of which it is not known what it will be.
  bool is_in_doubt(const std::string& name) const {
    return !own_are_sound_ && std::any_of(study_.own_metrics.begin(), study_.own_metrics.end(),
                                          [&](const OwnMetric& own) { return own.name == name; });
  }

  void check_kept() {
    const std::string& by = study_.kept.worst_by;
    std::vector<std::string> names;
    for (const Metric& metric : study_.metrics) names.push_back(metric.name);
    if (by.empty() || is_in_doubt(by) || std::find(names.begin(), names.end(), by) != names.end()) return;
    faults_.add({name_}, fmt::format("sweep.keep_worst_by = \"{}\": this study has no such metric; {}", by,
                                     suggestion(by, names)));
  }

  void read_thresholds() {
    const std::vector<const toml::table*> tables = root_.tables("threshold");
    for (std::size_t k = 0; k < tables.size(); ++k) {
      TableReader table(tables[k], fmt::format("threshold[{}]", k), Axis::rotary, faults_, root_.where());
      std::vector<std::string> names;
      for (const Metric& metric : study_.metrics) names.push_back(metric.name);
      if (const auto name = table.text("metric")) {
        const auto found = std::find(names.begin(), names.end(), *name);
        if (is_in_doubt(*name)) {
          table.ignore_unknown();
        } else if (found == names.end()) {
          table.fault("metric", fmt::format("this study has no metric '{}'; {}", *name, suggestion(*name, names)));
          table.ignore_unknown();
        } else {
          read_limit(table, study_.metrics[static_cast<std::size_t>(found - names.begin())]);
        }
      } else if (!table.has("metric")) {
        table.lacks("'metric'");
        table.ignore_unknown();
      }
      table.finish();
    }
  }

  void read_limit(TableReader& table, const Metric& metric) {
    const auto limit = [&](const char* name) {
      return table.number(name, metric.unit, bounds::any, Presence::optional, "limit");
    };
    const auto above = limit("above"), below = limit("below");
    if (!above && !below) table.ignore_unknown();
    const std::string key = spellings("above", metric.unit, Axis::rotary).front().key;
    if (above.has_value() == below.has_value() && faults_.empty())
      table.fault("metric", fmt::format("a threshold states either {} or {}", key,
                                        spellings("below", metric.unit, Axis::rotary).front().key));
    const double until = table
                             .number("until", unit::percent, bounds::between(1e-4, 1.0), Presence::optional,
                                     "width of the interval at which the sweep ends")
                             .value_or(0.0);
    if (until > 0.0 && !std::holds_alternative<MonteCarlo>(study_.design))
      table.fault("until_percent",
                  fmt::format("{} is for sweep.design = \"monte_carlo\": the trials of another design belong together; "
                              "remove one of the two",
                              table.path_of("until_percent")));
    study_.thresholds.push_back({metric.name, above ? *above : below.value_or(0.0), above.has_value(), until});
  }

  std::string name_;
  TableReader root_;
  Diagnostics& faults_;
  DataColumns& data_;
  bool in_table_;  ///< the parameters have the values of a table
  Study study_;
  bool own_are_sound_ = true;  ///< no fault was found in a [[metric]]
  std::vector<Setting> settings_;
  std::vector<StatedParameter> stated_;
};

/// folder: that of the files that the study names; nothing where its text has all of them.
Study read(const std::string& text, const std::string& name, const std::optional<std::string>& folder,
           const std::function<Scenario(const std::string& scenario, const std::vector<Setting>&)>& source) {
  const toml::table root = parse_document(text, name, {});
  if (root.contains("mesh") && !root.contains("sweep"))
    reject({name},
           "this is a scenario, for wormdrive run; a sweep needs a study, which names the scenario: "
           "scenario = \"FILE.toml\", [sweep], [[parameter]]; see " +
               documentation_page("howto/first_sweep.md"));
  Diagnostics faults;
  const std::string scenario = root["scenario"].value_or(std::string());
  DataColumns data(root, folder);
  Study study =
      StudyReader(root, name, faults, data).read([&](const auto& settings) { return source(scenario, settings); });
  faults.raise();
  study.text = text;
  if (const std::string columns = data.text(); !columns.empty())
    study.text += (text.ends_with('\n') ? "" : "\n") + columns;
  return study;
}

/// A fault of an override is told where the study states it.
std::vector<Fault> relocated(std::vector<Fault> faults, const std::vector<Setting>& settings) {
  for (Fault& fault : faults)
    for (const Setting& setting : settings)
      if (fault.where.file == "--set " + setting.assignment) {
        fault.where = setting.where;
        break;
      }
  return faults;
}

void flatten(const toml::node& node, const std::string& path, std::map<std::string, std::string>& into) {
  if (const toml::table* const table = node.as_table()) {
    for (const auto& [key, value] : *table)
      flatten(value, path.empty() ? std::string(key.str()) : fmt::format("{}.{}", path, key.str()), into);
  } else if (const toml::array* const array = node.as_array()) {
    for (std::size_t k = 0; k < array->size(); ++k) flatten(*array->get(k), fmt::format("{}[{}]", path, k), into);
  } else {
    std::ostringstream value;
    value.imbue(std::locale::classic());
    node.visit([&](const auto& leaf) { value << leaf; });
    into[path] = value.str();
  }
}

}  // namespace

Study load_study(const std::string& path) { return read_study(read_text(path), path); }

Study read_study(const std::string& text, const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  std::string file;
  const auto scenario_of = [&](const std::string& scenario, const std::vector<Setting>& settings) {
    std::vector<std::string> overrides;
    for (const Setting& setting : settings) overrides.push_back(setting.assignment);
    file = (folder / scenario).string();
    try {
      return load_scenario(file, overrides, Purpose::run);
    } catch (const InputFault& fault) {
      throw InputFault(relocated(fault.faults, settings));
    }
  };
  Study study = read(text, path, folder.string(), scenario_of);
  study.scenario_file = file;
  return study;
}

Study parse_study(const std::string& text, const std::string& scenario, const std::string& name) {
  return read(text, name, std::nullopt, [&](const std::string&, const std::vector<Setting>&) {
    return parse_scenario(scenario, name, {}, Purpose::run);
  });
}

std::optional<std::string> difference(const std::string& before, const std::string& after) {
  std::map<std::string, std::string> old, now;
  flatten(parse_document(before, "before", {}), "", old);
  flatten(parse_document(after, "after", {}), "", now);
  const auto value = [](const auto& map, const std::string& key) {
    const auto found = map.find(key);
    return found == map.end() ? std::string("not stated") : found->second;
  };
  std::map<std::string, std::string> all = old;
  all.insert(now.begin(), now.end());
  for (const auto& entry : all)
    if (const std::string& key = entry.first; value(old, key) != value(now, key))
      return fmt::format("{}: {}, then {}", key, value(old, key), value(now, key));
  return std::nullopt;
}

}  // namespace wormdrive
