#include <string>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/commands/diff/compare_results.hpp"
#include "cli/commands/sweep/diff_sweeps.hpp"
#include "cli/describe/drive.hpp"
#include "cli/report/result_file.hpp"
#include "description/diagnostics.hpp"

namespace wormdrive {
namespace {

constexpr int agree = 0, differ = 1;

void print(const ResultComparison& result) {
  for (const std::string& note : result.notes) fmt::print("  note: {}\n", note);
  for (const SignalDifference& s : result.signals)
    if (!s.attribute || s.too_large())  // those that agree would fill a screen
      fmt::print("  {:<36} {:>12.4g} at {:<12} allowed {:<10.3g} {}\n", s.signal, s.largest, in_words(s.at), s.allowed,
                 s.too_large() ? "DIFFERS" : "");
  for (const std::string& fault : result.faults) fmt::print("  {}\n", fault);
  fmt::print("{}: {} events and {} rows compared\n", result.differs() ? "the results differ" : "the results agree",
             result.events, result.rows());
}

/// A number where one column says where the row stands, a list where several do, null for what stands nowhere.
nlohmann::json as_json(const RowPlace& place) {
  nlohmann::json list = nlohmann::json::array();
  for (const auto& part : place) std::visit([&](const auto& value) { list.push_back(value); }, part);
  if (list.empty()) return nullptr;
  return list.size() == 1 ? list.front() : list;
}

nlohmann::json as_json(const ResultComparison& result) {
  nlohmann::json json{{"agree", !result.differs()},
                      {"events", result.events},
                      {"rows", result.rows()},
                      {"notes", result.notes},
                      {"faults", result.faults},
                      {"tables", nlohmann::json::array()},
                      {"signals", nlohmann::json::array()}};
  for (const TableRows& t : result.tables)
    json["tables"].push_back(
        {{"table", t.table}, {"rows", t.common}, {"first_only", t.first_only}, {"second_only", t.second_only}});
  for (const SignalDifference& s : result.signals)
    json["signals"].push_back({{"signal", s.signal},
                               {"largest", s.largest},
                               {"at", as_json(s.at)},
                               {"allowed", s.allowed},
                               {"differs", s.too_large()}});
  return json;
}

std::string kind_of(const ResultFile& file) { return file.attribute("/", "kind"); }

int diff_command(const DiffOptions& options) {
  if (is_sweep(options.first) && is_sweep(options.second)) return diff_sweeps(options);
  std::vector<std::string> paths{options.first};
  if (options.second != options.first) paths.push_back(options.second);
  const std::vector<ResultFile> files = open_results(paths);
  const ResultFile &a = files.front(), &b = files.back();
  if (kind_of(a) != kind_of(b))
    reject({b.path()}, fmt::format("it is a result of '{}', but {} is one of '{}'; diff compares results of one kind",
                                   kind_of(b), a.path(), kind_of(a)));
  const ResultComparison result = compare_results(a, b, options);
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
