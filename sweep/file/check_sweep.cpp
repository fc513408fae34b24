#include "sweep/file/check_sweep.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "sweep/file/sweep_file.hpp"
#include "sweep/summary/summary_tables.hpp"

namespace wormdrive {
namespace {

constexpr std::uint64_t rows_checked_at_once = 1 << 16;

TrialRange stored_range(hid_t file, const Study& study) {
  const std::int64_t first = read_integer_attribute(file, "first_trial"),
                     end = read_integer_attribute(file, "end_trial");
  const std::uint64_t trials = study.trials();
  if (first < 0 || end < first || static_cast<std::uint64_t>(end) > trials)
    throw ReadFault(file_of(file),
                    fmt::format("its trials {} to {} are not among the {} of its study", first, end - 1, trials));
  return {static_cast<std::uint64_t>(first), static_cast<std::uint64_t>(end)};
}

/// Those of the study, where a file states them: older files do not.
void check_blocks(hid_t file, const Study& study) {
  if (H5Aexists(file, "block_trials") <= 0) return;
  const Block block = block_of(study.design, study.parameters.size());
  const std::int64_t trials = read_integer_attribute(file, "block_trials"),
                     draws = read_integer_attribute(file, "block_draws");
  if (trials != static_cast<std::int64_t>(block.trials) || draws != static_cast<std::int64_t>(block.draws))
    throw ReadFault(file_of(file),
                    fmt::format("its blocks of {} trials with {} draws are not those of its study, of {} "
                                "with {}",
                                trials, draws, block.trials, block.draws));
}

/// Calls visit(trial, value, whether it is there) for the rows of a column.
template <class Visit>
void for_each_row(const StoredTable& trials, const std::string& name, TrialRange range, Visit&& visit) {
  const StoredColumn &column = trials.column(name), &status = trials.column("status");
  for (std::uint64_t row = 0; row < range.size(); row += rows_checked_at_once) {
    const std::uint64_t count = std::min(rows_checked_at_once, range.size() - row);
    const std::vector<double> there = status.values(row, count);  // first: a running sweep writes it last
    const std::vector<double> values = column.values(row, count);
    for (std::uint64_t k = 0; k < count; ++k) visit(range.first + row + k, values[k], there[k] != 0.0);
  }
}

/// The texts are read after the rows that mean them: a running sweep writes them before.
void check_reasons(hid_t file, const StoredTable& trials, TrialRange range) {
  const auto reject = [&](std::uint64_t trial, double value) {
    trials.column("reason").reject(fmt::format("contains {} for trial {}, but there are only {} reasons", value, trial,
                                               read_fixed_texts(file, "reasons").size()));
  };
  double last = 0.0;
  std::uint64_t last_trial = range.first;
  for_each_row(trials, "reason", range, [&](std::uint64_t trial, double value, bool there) {
    if (!there) return;
    if (!(value >= 0.0 && value < 0x1p53 && std::trunc(value) == value)) reject(trial, value);
    if (value > last) {
      last = value;
      last_trial = trial;
    }
  });
  if (last > static_cast<double>(read_fixed_texts(file, "reasons").size())) reject(last_trial, last);
}

void check_referee(const StoredTable& referee, TrialRange range) {
  const StoredColumn &judged = referee.column("judged"), &trial = referee.column("trial");
  const std::vector<double> states = judged.values(), trials = trial.values();
  for (std::size_t k = 0; k < states.size(); ++k) {
    if (states[k] != 0.0 && states[k] != 1.0 && states[k] != 2.0)
      judged.reject(fmt::format("contains {} instead of 0, 1 or 2", states[k]));
    const bool whole = trials[k] >= 0.0 && trials[k] < 0x1p53 && std::trunc(trials[k]) == trials[k];
    const auto at = whole ? static_cast<std::uint64_t>(trials[k]) : range.end;
    if (states[k] != 0.0 && (at < range.first || at >= range.end))
      trial.reject(fmt::format("contains {}, which is not a trial of the file", trials[k]));
  }
}

}  // namespace

StoredTrials check_sweep(hid_t file, const Study& study) {
  const TrialRange range = stored_range(file, study);
  check_blocks(file, study);
  for (const char* const name : {"title", "command_line"}) read_text_attribute(file, name);
  if (H5Aexists(file, "sources") > 0) read_text_attribute(file, "sources");  // older files have none
  StoredTable trials(file, "trials"), referee(file, "referee");
  for (ColumnDescription column : trial_columns(study)) {
    if (column.is_flag()) column.flag_values.push_back(0);  // of a trial that was not made yet
    trials.check(column, Range::any);
  }
  if (trials.rows() != range.size())
    trials.column("status").reject(
        fmt::format("has {} rows, but the file is of {} trials", trials.rows(), range.size()));
  for_each_row(trials, "index", range, [&](std::uint64_t trial, double value, bool there) {
    if (there && value != static_cast<double>(trial))
      trials.column("index").reject(fmt::format("contains {} in the row of trial {}", value, trial));
  });
  check_fixed_texts(StoredColumn(file, "reasons"), ReasonTable::most);
  check_reasons(file, trials, range);
  for (const UncertainParameter& p : study.parameters)
    for_each_row(trials, p.name, range, [&](std::uint64_t trial, double value, bool there) {
      if (there && !std::isfinite(value))
        trials.column(p.name).reject(fmt::format("holds {} for trial {}, which is not finite", value, trial));
    });
  for (const ColumnDescription& column : verdict_columns(study.scenario.axis)) referee.check(column, Range::any);
  if (referee.rows() != most_verdicts)
    referee.column("judged").reject(fmt::format("has {} rows instead of {}", referee.rows(), most_verdicts));
  check_referee(referee, range);
  check_summary_tables(file, study);
  return {range, std::move(trials), std::move(referee)};
}

}  // namespace wormdrive
