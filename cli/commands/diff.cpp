#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/commands/sweep/diff_sweeps.hpp"
#include "cli/describe/drive.hpp"
#include "cli/report/result_file.hpp"
#include "description/diagnostics.hpp"
#include "output/trajectory.hpp"

namespace wormdrive {
namespace {

constexpr int agree = 0, differ = 1;

/// The tables of result files that are compared row by row, with what their rows stand over.
constexpr std::pair<const char*, const char*> compared_tables[] = {{"trajectory", "time"},     {"controller", "time"},
                                                                   {"statics", "load_torque"}, {"model", "worm_speed"},
                                                                   {"levels", "index"},        {"estimates", "index"}};

/// How one signal of two results compares.
struct Difference {
  std::string signal;
  double largest = 0.0, at = 0.0, allowed = 0.0;
  bool too_large() const { return !(largest <= allowed); }  // NaN too
};

struct FileComparison {
  std::vector<Difference> signals;
  std::vector<std::string> faults;  ///< what is not a matter of size
  std::size_t rows = 0, events = 0;

  bool differs() const {
    return !faults.empty() || std::any_of(signals.begin(), signals.end(), [](const auto& s) { return s.too_large(); });
  }
};

/// Rows of two tables that stand at the same place.
std::vector<std::pair<std::size_t, std::size_t>> common_rows(const std::vector<double>& a,
                                                             const std::vector<double>& b) {
  const auto span = [](const auto& x) { return x.empty() ? 0.0 : std::abs(x.back() - x.front()); };
  const double same = 1e-12 * std::max(span(a), span(b));
  std::vector<std::pair<std::size_t, std::size_t>> rows;
  for (std::size_t i = 0, j = 0; i < a.size() && j < b.size();) {
    if (std::abs(a[i] - b[j]) <= same)
      rows.emplace_back(i++, j++);
    else
      ++(a[i] < b[j] ? i : j);
  }
  return rows;
}

void compare_table(const ResultFile& a, const ResultFile& b, const std::string& table, const std::string& over,
                   const DiffOptions& allowed, const std::vector<double>& events, FileComparison& result) {
  const std::vector<double> at_a = a.column(table + "/" + over), at_b = b.column(table + "/" + over);
  const auto rows = common_rows(at_a, at_b);
  if (rows.empty()) {
    result.faults.push_back(fmt::format("{}: no {} in common", table, over));
    return;
  }
  result.rows += rows.size();
  if (over == "time")
    if (const double end_a = at_a.back(), end_b = at_b.back(); !(std::abs(end_a - end_b) <= allowed.time))
      result.faults.push_back(
          fmt::format("{}: ends at {:.9g} s in the first result, {:.9g} s in the second", table, end_a, end_b));
  const std::vector<std::string> of_b = b.columns(table);
  for (const std::string& name : a.columns(table)) {
    if (name == over) continue;
    if (std::find(of_b.begin(), of_b.end(), name) == of_b.end()) {
      result.faults.push_back(fmt::format("{}/{}: in {} only", table, name, a.path()));
      continue;
    }
    const std::vector<double> x = a.column(table + "/" + name), y = b.column(table + "/" + name);
    Difference d{table + "/" + name};
    double size = 0.0;
    for (const auto& [i, j] : rows) {
      size = std::max({size, std::abs(x[i]), std::abs(y[j])});
      // an event that is late by less than is allowed: for so long the one is before it and the other behind
      const auto event = std::lower_bound(events.begin(), events.end(), at_a[i] - allowed.time);
      if (event != events.end() && *event <= at_a[i] + allowed.time) continue;
      const double difference = std::isnan(x[i]) && std::isnan(y[j]) ? 0.0 : std::abs(x[i] - y[j]);
      if (difference <= d.largest) continue;
      d.largest = difference;
      d.at = at_a[i];
    }
    d.allowed = allowed.absolute + allowed.relative * size;
    result.signals.push_back(d);
  }
  for (const std::string& name : of_b)
    if (const auto of_a = a.columns(table); std::find(of_a.begin(), of_a.end(), name) == of_a.end())
      result.faults.push_back(fmt::format("{}/{}: in {} only", table, name, b.path()));
}

std::string event_name(double kind) {
  const auto k = static_cast<std::size_t>(kind);
  return k < event_kind_count ? std::string(name(event_kinds[k])) : fmt::format("kind {}", kind);
}

void compare_events(const ResultFile& a, const ResultFile& b, const DiffOptions& allowed, FileComparison& result) {
  const auto ta = a.column("events/time"), tb = b.column("events/time");
  const auto ka = a.column("events/kind"), kb = b.column("events/kind");
  if (ta.size() != tb.size())
    result.faults.push_back(fmt::format("events: {} in the first result, {} in the second", ta.size(), tb.size()));
  Difference late{"events/time"};
  late.allowed = allowed.time;
  for (std::size_t k = 0; k < std::min(ta.size(), tb.size()); ++k) {
    if (ka[k] != kb[k]) {
      result.faults.push_back(fmt::format("event {}: {} at {:.9g} s in the first result, {} at {:.9g} s in the second",
                                          k + 1, event_name(ka[k]), ta[k], event_name(kb[k]), tb[k]));
      break;  // what follows is another course
    }
    ++result.events;
    if (const double d = std::abs(ta[k] - tb[k]); d > late.largest) {
      late.largest = d;
      late.at = ta[k];
    }
  }
  result.signals.push_back(late);
}

FileComparison compare(const ResultFile& a, const ResultFile& b, const DiffOptions& options) {
  FileComparison result;
  std::vector<double> events;
  if (a.has("events") && b.has("events")) {
    compare_events(a, b, options, result);
    for (const ResultFile* file : {&a, &b}) {
      const auto times = file->column("events/time");
      events.insert(events.end(), times.begin(), times.end());
    }
    std::sort(events.begin(), events.end());
  }
  bool any = false;
  for (const auto& [table, over] : compared_tables) {
    if (a.has(table) && b.has(table)) {
      any = true;
      compare_table(a, b, table, over, options, events, result);
    } else if (a.has(table) || b.has(table)) {
      result.faults.push_back(fmt::format("{}: in {} only", table, (a.has(table) ? a : b).path()));
    }
  }
  if (!any && result.faults.empty()) reject({b.path()}, fmt::format("has no table in common with {}", a.path()));
  return result;
}

void print(const FileComparison& result) {
  for (const Difference& s : result.signals)
    fmt::print("  {:<36} {:>12.4g} at {:<12.6g} allowed {:<10.3g} {}\n", s.signal, s.largest, s.at, s.allowed,
               s.too_large() ? "DIFFERS" : "");
  for (const std::string& fault : result.faults) fmt::print("  {}\n", fault);
  fmt::print("{}: {} events and {} rows compared\n", result.differs() ? "the results differ" : "the results agree",
             result.events, result.rows);
}

nlohmann::json as_json(const FileComparison& result) {
  nlohmann::json json{{"agree", !result.differs()},
                      {"events", result.events},
                      {"rows", result.rows},
                      {"faults", result.faults},
                      {"signals", nlohmann::json::array()}};
  for (const Difference& s : result.signals)
    json["signals"].push_back({{"signal", s.signal},
                               {"largest", s.largest},
                               {"at", s.at},
                               {"allowed", s.allowed},
                               {"differs", s.too_large()}});
  return json;
}

int diff_command(const DiffOptions& options) {
  if (is_sweep(options.first) && is_sweep(options.second)) return diff_sweeps(options);
  std::vector<std::string> paths{options.first};
  if (options.second != options.first) paths.push_back(options.second);
  const std::vector<ResultFile> files = open_results(paths);
  const ResultFile &a = files.front(), &b = files.back();
  const FileComparison result = compare(a, b, options);
  if (options.json) print_json(as_json(result));
  if (!options.json && !options.quiet) print(result);
  return result.differs() ? differ : agree;
}

}  // namespace

void add_diff(CommandSet& commands) {
  auto [command, options] =
      commands.add("diff", "compare two results; exit code 0 if they agree, 1 if they differ", diff_command);
  command.add_option("first", options.first, "result (.h5)")->required();
  command.add_option("second", options.second, "result (.h5)")->required();
  const CLI::Validator not_negative = finite_number(true);
  command
      .add_option("--relative", options.relative, "allowed difference, as a share of the signal's largest magnitude")
      ->check(not_negative)
      ->capture_default_str();
  command.add_option("--absolute", options.absolute, "allowed difference in addition, in the unit of the signal")
      ->check(not_negative)
      ->capture_default_str();
  command.add_option("--time", options.time, "allowed difference of event times [s]")
      ->check(not_negative)
      ->capture_default_str();
  command.add_flag("-q,--quiet", options.quiet, "print nothing; the exit code is the answer");
  add_json(command, options.json);
}

}  // namespace wormdrive
