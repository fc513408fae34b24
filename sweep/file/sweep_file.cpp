#include "sweep/file/sweep_file.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>

#include <fmt/format.h>

#include "description/keys.hpp"
#include "description/toml/write_scenario.hpp"
#include "output/program.hpp"
#include "sweep/summary/summary_tables.hpp"

namespace wormdrive {
namespace {

constexpr std::size_t rows_at_once = 1 << 16;  ///< handed to the file, as far as some time does not pass before

}  // namespace

std::vector<ColumnDescription> trial_columns(const Study& study) {
  const auto units = [](const Unit& unit) { return std::string(unit.symbol); };
  std::vector<ColumnDescription> list{{"index", "1", "number of the trial, counted from 0"}};
  for (const UncertainParameter& p : study.parameters)
    list.push_back({p.name, units(p.si_unit), "parameter " + p.path});
  for (const Metric& m : study.metrics) list.push_back({m.name, units(m.unit), m.meaning});
  ColumnDescription status{"status", "", "how the trial ended", "", {}};
  for (const TrialStatus value : trial_statuses) {
    status.flag_meanings += fmt::format("{}{}", status.flag_meanings.empty() ? "" : " ", name(value));
    status.flag_values.push_back(static_cast<std::int8_t>(value));
  }
  list.push_back({"reason", "1", "why it is not done: k stands for the k-th text of /reasons, 0 for none"});
  list.push_back(std::move(status));  // the last one: it says that the row is there
  return list;
}

std::vector<ColumnDescription> verdict_columns(Axis axis) {
  std::vector<ColumnDescription> list{
      {"judged", "1", "1: CVODE has run the trial again, 2: it could not go on, 0: the row is not used"},
      {"trial", "1", "index of the trial"},
      {"angle_difference", "rad", "largest difference of the gear angle under the recorded motor torque"},
      {"speed_difference", "rad/s", "of the gear speed"},
      {"time", "s", "when the angles differ most"},
      {"closed_angle_difference", "rad",
       "largest difference of the gear angle with the own controller; not a number where a sensor rounds to counts, or "
       "it was not asked"},
      {"closed_speed_difference", "rad/s", "of the gear speed"},
      {"closed_time", "s", "when these angles differ most"},
      {"parted", "s", "where a sensor rounds to counts: first sample with another count; not a number if none has"}};
  for (ColumnDescription& column : list) {
    column.units = units_on(axis, column.units);
    column.long_name = in_words_of(axis, column.long_name);
  }
  return list;
}

void SweepFile::create(const std::string& path, const Study& study, TrialRange range, const std::string& command_line,
                       Replace replace) {
  reject_replacing(path, "sweep", replace);
  // so that NAME.part is whole from its first moment on
  PartFile file(path + ".part", OutputLock(), "sweep", Replace::anything);
  write_provenance(file.file(), {"sweep", study.title, to_toml(study.scenario), command_line});
  write_attribute(file.file(), "study", study.text);
  write_attribute(file.file(), "build", program_identity());
  write_attribute(file.file(), "first_trial", static_cast<std::int64_t>(range.first));
  write_attribute(file.file(), "end_trial", static_cast<std::int64_t>(range.end));
  const Block block = block_of(study.design, study.parameters.size());
  write_attribute(file.file(), "block_trials", static_cast<std::int64_t>(block.trials));
  write_attribute(file.file(), "block_draws", static_cast<std::int64_t>(block.draws));
  FixedTexts::create(file.file(), "reasons", "of each kind of reasons why trials are not done the first one",
                     ReasonTable::most);
  FixedTable::create(file.file(), "trials", trial_columns(study), range.size());
  FixedTable::create(file.file(), "referee", verdict_columns(study.scenario.axis), most_verdicts);
  create_summary_tables(file.file(), study);
  file.finish();
}

SweepFile::SweepFile(const std::string& path, const Study& study, TrialRange range, ReasonTable reasons,
                     Replace replace)
    : axis_(study.scenario.axis),
      range_(range),
      file_(PartFile::reopened(path, "sweep", replace)),
      columns_(study.parameters.size() + study.metrics.size() + 3),
      reasons_(std::move(reasons)),
      flushed_(Clock::now()) {
  table_.emplace(file_.file(), "trials", trial_columns(study));
  reason_texts_.emplace(file_.file(), "reasons");
  for (const ReasonTable::Entry& entry : reasons_.entries()) reasons_written_.push_back(entry.example);
}

void SweepFile::append(Trial trial) {
  waiting_.push_back(std::move(trial));
  if (waiting_.size() >= rows_at_once)
    flush();
  else
    keep_safe();
}

void SweepFile::keep_safe() {
  if (Clock::now() - flushed_ >= longest_wait) flush();
}

void SweepFile::flush() {
  flushed_ = Clock::now();
  if (waiting_.empty()) return;
  std::sort(waiting_.begin(), waiting_.end(), [](const Trial& a, const Trial& b) { return a.index < b.index; });
  const auto for_each_run = [this](auto&& write_run) {  // of trials one after the other
    for (std::size_t first = 0, end = 0; first < waiting_.size(); first = end) {
      while (++end < waiting_.size() && waiting_[end].index == waiting_[end - 1].index + 1) continue;
      write_run(std::span<const Trial>(waiting_).subspan(first, end - first));
    }
  };
  for_each_run([this](std::span<const Trial> run) { write(run, Part::all_but_status); });
  make_safe();
  for_each_run([this](std::span<const Trial> run) { write(run, Part::status); });
  file_.flush();
  waiting_.clear();
}

void SweepFile::copy(std::span<const SweepPiece> pieces) {
  if (pieces.empty()) return;
  const std::vector<ColumnDescription> columns = trial_columns(pieces.front().file->study());
  const std::size_t reason = columns.size() - 2, status = columns.size() - 1;
  const auto copy_column = [&](std::size_t column) {
    for (const auto& [range, from] : pieces)
      from->for_each_block(range, columns[column].name, [&](std::uint64_t first, const std::vector<double>& values) {
        table_->write(column, first - range_.first,
                      column == reason ? recoded(values, from->reasons(), first) : values);
      });
  };
  for (std::size_t k = 0; k < status; ++k) copy_column(k);
  make_safe();
  copy_column(status);
  file_.flush();
}

void SweepFile::make_safe() {
  write_reasons();
  // A row is there only once it has a status, and it has one only when all else is on the disk: a kill or a power cut
  // between the two costs rows, but leaves none that only seem to be there.
  file_.flush();
  synchronise(part_path());
}

void SweepFile::write(std::span<const Trial> trials, Part part) {
  const std::uint64_t row = trials.front().index - range_.first;
  std::vector<double> values(trials.size());
  std::size_t column = part == Part::status ? columns_ - 1 : 0;
  const auto write_column = [&](auto&& value_of) {
    std::transform(trials.begin(), trials.end(), values.begin(), value_of);
    table_->write(column++, row, values);
  };
  if (part == Part::status) {
    write_column([](const Trial& trial) { return static_cast<double>(trial.status); });
    return;
  }
  write_column([](const Trial& trial) { return static_cast<double>(trial.index); });
  for (std::size_t k = 0; k < trials.front().parameters.size(); ++k)
    write_column([k](const Trial& trial) { return trial.parameters[k]; });
  for (std::size_t k = 0; k < trials.front().metrics.size(); ++k)
    write_column([k](const Trial& trial) { return trial.metrics[k]; });
  write_column([this](const Trial& t) { return static_cast<double>(reasons_.code(t.reason, t.index)); });
}

std::vector<double> SweepFile::recoded(std::vector<double> codes, const std::vector<std::string>& reasons,
                                       std::uint64_t first) {
  std::vector<std::uint64_t> trials(reasons.size() + 1);  // by code: reading a reason takes longer than counting it
  for (const double code : codes) ++trials.at(static_cast<std::size_t>(code));
  std::vector<std::size_t> recoded(reasons.size() + 1);
  for (std::size_t k = 0; k < codes.size(); ++k) {
    const auto code = static_cast<std::size_t>(codes[k]);
    if (code == 0) continue;
    if (recoded[code] == 0) recoded[code] = reasons_.code(reasons[code - 1], first + k, trials[code]);
    codes[k] = static_cast<double>(recoded[code]);
  }
  return codes;
}

void SweepFile::write_reasons() {
  reasons_written_.resize(reasons_.entries().size());
  for (std::size_t k = 0; k < reasons_written_.size(); ++k) {
    const std::string& example = reasons_.entries()[k].example;
    if (reasons_written_[k] == example) continue;
    reason_texts_->write(k, example);
    reasons_written_[k] = example;
  }
}

void SweepFile::drop_from(std::uint64_t trial) {
  flush();
  const std::vector<TrialRange> present = SweepReader(part_path()).present();
  for (const TrialRange& range : present)
    for (std::uint64_t first = std::max(range.first, trial); first < range.end; first += rows_at_once)
      table_->write(columns_ - 1, first - range_.first,
                    std::vector<double>(std::min<std::uint64_t>(rows_at_once, range.end - first)));
  file_.flush();
}

void SweepFile::end_before(std::uint64_t trial) {
  drop_from(trial);
  range_.end = trial;
  ends_early_ = true;
}

void SweepFile::write(const std::vector<RefereeVerdict>& verdicts) {
  const std::size_t count = std::min(verdicts.size(), most_verdicts);
  std::vector<std::vector<double>> columns(verdict_columns(axis_).size());
  for (std::size_t k = 0; k < count; ++k) {
    const auto& [trial, found, in_loop, halted] = verdicts[k];
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const Disagreement closed = in_loop.closed.value_or(Disagreement{none, none, none});
    auto column = columns.begin();
    for (const double value : {halted ? 2.0 : 1.0, static_cast<double>(trial), found.angle, found.speed, found.t,
                               closed.angle, closed.speed, closed.t, in_loop.parted.value_or(none)})
      (column++)->push_back(value);
  }
  FixedTable table(file_.file(), "referee", verdict_columns(axis_));
  for (std::size_t k = 0; k < columns.size(); ++k) table.write(k, 0, columns[k]);
}

void SweepFile::finish() {
  flush();
  if (ends_early_ || !reasons_.in_order()) {
    finish_in_order();
    return;
  }
  {
    const SweepReader all(part_path());
    write_summary_tables(file_.file(), summarise(all, {.worst = worst_trials_listed}), all.study());
  }
  table_.reset();
  reason_texts_.reset();
  file_.finish();
}

void SweepFile::finish_in_order() {
  const std::string path = file_.path() + ".in_order";
  try {
    const SweepReader all(part_path());
    create(path, all.study(), range_, read_text_attribute(file_.file(), "command_line"), Replace::anything);
    SweepFile copy(path, all.study(), range_, {}, Replace::anything);
    std::vector<SweepPiece> pieces;
    for (const TrialRange& range : all.present()) pieces.push_back({range, &all});
    copy.copy(pieces);
    copy.write(all.verdicts());
    copy.finish();
  } catch (...) {
    std::error_code ignored;  // NAME.part has all of it
    std::filesystem::remove(path + ".part", ignored);
    throw;
  }
  file_.give_way_to(path);
}

}  // namespace wormdrive
