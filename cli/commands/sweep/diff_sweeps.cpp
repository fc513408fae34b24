#include "cli/commands/sweep/diff_sweeps.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "cli/describe/drive.hpp"
#include "cli/report/result_file.hpp"
#include "description/diagnostics.hpp"
#include "sweep/file/so_far.hpp"
#include "sweep/file/sweep_file.hpp"
#include "sweep/ranks/rank_files.hpp"

namespace wormdrive {
namespace {

constexpr std::size_t most_listed = 5;  ///< trials of each column, and ranges

/// How a column of two sweeps compares.
struct ColumnDifference {
  std::string name;
  double largest = 0.0, allowed = 0.0;
  std::uint64_t at = 0;               ///< the trial of the largest difference
  std::vector<std::uint64_t> beyond;  ///< trials whose difference is not allowed
};

struct SweepComparison {
  std::vector<ColumnDifference> columns;
  std::vector<std::string> faults;  ///< what is not a matter of size
  std::vector<std::string> notes;   ///< what differs beside the trials
  std::uint64_t trials = 0;         ///< that both have
  bool differs() const {
    return !faults.empty() ||
           std::any_of(columns.begin(), columns.end(), [](const auto& c) { return !c.beyond.empty(); });
  }
};

std::vector<double> column(const SweepReader& sweep, const std::string& name) {
  std::vector<double> all;
  sweep.for_each_block({name}, [&](const SweepReader::Block& block) {
    all.insert(all.end(), block.columns.front().begin(), block.columns.front().end());
  });
  return all;
}

/// "3, 17, 22, ..."
std::string listed(const std::vector<std::uint64_t>& trials) {
  const std::vector<std::uint64_t> first(trials.begin(), trials.begin() + std::min(most_listed, trials.size()));
  return fmt::format("{}{}", fmt::join(first, ", "), trials.size() > most_listed ? ", ..." : "");
}

/// Trials that one sweep has, under this name, and the other lacks.
std::string only_in(const SweepReader& has, const std::string& name, const SweepReader& lacks) {
  std::vector<TrialRange> ranges;
  for (const TrialRange& range : has.present()) {
    std::vector<TrialRange> common;
    for (const TrialRange& other : lacks.present())
      if (other.first < range.end && range.first < other.end)
        extend(common, {std::max(range.first, other.first), std::min(range.end, other.end)});
    for (const TrialRange& alone : outside(common, range)) extend(ranges, alone);
  }
  std::vector<std::string> texts;
  for (const TrialRange& range : ranges)
    if (texts.size() < most_listed)
      texts.push_back(range.size() == 1 ? fmt::format("{}", range.first)
                                        : fmt::format("{} to {}", range.first, range.end - 1));
  if (texts.empty()) return "";
  return fmt::format("{} trial{} in {} only: {}{}", trials_in(ranges), trials_in(ranges) == 1 ? "" : "s", name,
                     fmt::join(texts, ", "), ranges.size() > most_listed ? ", ..." : "");
}

/// The trials that both have.
std::vector<std::uint64_t> common_trials(const SweepReader& a, const SweepReader& b) {
  std::vector<std::uint64_t> common;
  auto other = b.present().begin();
  for (const TrialRange& range : a.present())
    for (std::uint64_t trial = range.first; trial < range.end; ++trial) {
      while (other != b.present().end() && other->end <= trial) ++other;
      if (other != b.present().end() && other->first <= trial) common.push_back(trial);
    }
  return common;
}

class Comparer {
 public:
  Comparer(const SweepReader& a, const SweepReader& b, const DiffOptions& allowed)
      : a_(a), b_(b), allowed_(allowed), trials_(common_trials(a, b)) {}

  SweepComparison operator()() {
    result_.trials = trials_.size();
    if (const std::string why = a_.why_not_of(b_); !why.empty()) result_.notes.push_back(why);
    for (const std::string& fault : {only_in(a_, allowed_.first, b_), only_in(b_, allowed_.second, a_)})
      if (!fault.empty()) result_.faults.push_back(fault);
    const std::vector<std::string> of_a = names(a_), of_b = names(b_);
    for (const std::string& name : of_a)
      if (std::find(of_b.begin(), of_b.end(), name) == of_b.end())
        result_.faults.push_back(fmt::format("trials/{}: in {} only", name, allowed_.first));
      else
        compare(name);
    for (const std::string& name : of_b)
      if (std::find(of_a.begin(), of_a.end(), name) == of_a.end())
        result_.faults.push_back(fmt::format("trials/{}: in {} only", name, allowed_.second));
    compare_ends();
    return std::move(result_);
  }

 private:
  /// The columns of numbers that a size can be allowed for.
  static std::vector<std::string> names(const SweepReader& sweep) {
    std::vector<std::string> list;
    for (const UncertainParameter& p : sweep.study().parameters) list.push_back(p.name);
    for (const Metric& m : sweep.study().metrics) list.push_back(m.name);
    return list;
  }

  void compare(const std::string& name) {
    const std::vector<double> x = column(a_, name), y = column(b_, name);
    ColumnDifference difference;
    difference.name = "trials/" + name;
    double size = 0.0;
    for (const std::uint64_t trial : trials_)
      for (const double value : {x[trial - a_.range().first], y[trial - b_.range().first]})
        if (std::isfinite(value)) size = std::max(size, std::abs(value));
    difference.allowed = allowed_.absolute + allowed_.relative * size;
    for (const std::uint64_t trial : trials_) {
      const double value = x[trial - a_.range().first], other = y[trial - b_.range().first];
      if (value == other || (std::isnan(value) && std::isnan(other))) continue;
      const double apart = std::isfinite(value) && std::isfinite(other) ? std::abs(value - other)
                                                                        : std::numeric_limits<double>::infinity();
      if (apart > difference.allowed) difference.beyond.push_back(trial);
      if (apart <= difference.largest) continue;
      difference.largest = apart;
      difference.at = trial;
    }
    result_.columns.push_back(std::move(difference));
  }

  /// How trials ended, and of those that failed why: numbers of reasons stand for other kinds in every file.
  void compare_ends() {
    const std::vector<double> status_a = column(a_, "status"), status_b = column(b_, "status"),
                              reason_a = column(a_, "reason"), reason_b = column(b_, "reason");
    const std::vector<std::string> kinds_a = kinds(a_), kinds_b = kinds(b_);
    std::vector<std::uint64_t> ended, failed;
    for (const std::uint64_t trial : trials_) {
      const std::size_t i = trial - a_.range().first, j = trial - b_.range().first;
      if (status_a[i] != status_b[j])
        ended.push_back(trial);
      else if (kinds_a.at(static_cast<std::size_t>(reason_a[i])) != kinds_b.at(static_cast<std::size_t>(reason_b[j])))
        failed.push_back(trial);
    }
    const auto tell = [this](const std::vector<std::uint64_t>& trials, const std::string& what, auto&& said) {
      if (trials.empty()) return;
      result_.faults.push_back(fmt::format("{} trial{} {}: {}; trial {}: {} in the first result, {} in the second",
                                           trials.size(), trials.size() == 1 ? "" : "s", what, listed(trials),
                                           trials.front(), said(a_, trials.front()), said(b_, trials.front())));
    };
    tell(ended, "ended differently", [](const SweepReader& sweep, std::uint64_t trial) {
      return std::string(wormdrive::name(sweep.read({trial, trial + 1}).front().status));
    });
    tell(failed, "failed for another reason", [](const SweepReader& sweep, std::uint64_t trial) {
      return "'" + sweep.read({trial, trial + 1}).front().reason + "'";
    });
  }
  /// The kinds of reasons by their numbers; that of 0 is none.
  static std::vector<std::string> kinds(const SweepReader& sweep) {
    std::vector<std::string> list{""};
    for (const std::string& reason : sweep.reasons()) list.push_back(kind_of_reason(reason));
    return list;
  }

  const SweepReader &a_, &b_;
  const DiffOptions& allowed_;
  std::vector<std::uint64_t> trials_;
  SweepComparison result_;
};

void print(const SweepComparison& result) {
  for (const std::string& note : result.notes) fmt::print("  note: {}\n", note);
  for (const ColumnDifference& c : result.columns)
    fmt::print("  {:<36} {:>12.4g} in trial {:<8} allowed {:<10.3g} {}\n", c.name, c.largest, c.at, c.allowed,
               c.beyond.empty() ? ""
                                : fmt::format("DIFFERS in {} trial{}: {}", c.beyond.size(),
                                              c.beyond.size() == 1 ? "" : "s", listed(c.beyond)));
  for (const std::string& fault : result.faults) fmt::print("  {}\n", fault);
  fmt::print("{}: {} trials compared\n", result.differs() ? "the results differ" : "the results agree", result.trials);
}

nlohmann::json as_json(const SweepComparison& result) {
  nlohmann::json json{{"agree", !result.differs()},
                      {"trials", result.trials},
                      {"notes", result.notes},
                      {"faults", result.faults},
                      {"signals", nlohmann::json::array()}};
  for (const ColumnDifference& c : result.columns)
    json["signals"].push_back({{"signal", c.name},
                               {"largest", c.largest},
                               {"at", c.at},
                               {"allowed", c.allowed},
                               {"differs", !c.beyond.empty()},
                               {"trials", c.beyond}});
  return json;
}

}  // namespace

bool is_sweep(const std::string& path) {
  if (std::error_code none; std::filesystem::exists(path, none)) {
    if (is_being_written(path)) return true;
    return is_hdf5(path) && ResultFile(path).attribute("/", "kind") == "sweep";
  }
  return std::filesystem::exists(path + ".part") || !rank_parts(path).empty();
}

int diff_sweeps(const DiffOptions& options) {
  const SweepSoFar first(options.first), second(options.second);
  const SweepReader a(first.path()), b(second.path());
  const SweepComparison result = Comparer(a, b, options)();
  if (options.json) print_json(as_json(result));
  if (!options.json && !options.quiet) print(result);
  return result.differs() ? 1 : 0;
}

}  // namespace wormdrive
