#include "sweep/sweep_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <fmt/format.h>

#include "output/program.hpp"
#include "scenarios/faults.hpp"
#include "scenarios/write_scenario.hpp"
#include "sweep/load_study.hpp"
#include "sweep/summary_tables.hpp"

namespace wormdrive {
namespace {

constexpr std::size_t rows_at_once = 4096;  ///< handed to the file, as far as a second does not pass before

/// Verdicts one after the other; a row of zeros is none.
std::vector<ColumnDescription> verdict_descriptions() {
  return {
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
}

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

ReasonTable::ReasonTable(const std::vector<std::string>& examples, const std::vector<std::uint64_t>& counts) {
  for (std::size_t k = 0; k < examples.size(); ++k) {
    codes_.emplace(kind_of_reason(examples[k]), k + 1);
    entries_.push_back({examples[k], counts[k]});
  }
}

std::size_t ReasonTable::code(const std::string& reason) {
  if (reason.empty()) return 0;
  const auto [known, is_new] = codes_.try_emplace(kind_of_reason(reason), entries_.size() + 1);
  if (is_new && entries_.size() == most) {
    codes_.erase(known);
    ++entries_.back().count;
    return most;
  }
  if (is_new) entries_.push_back({entries_.size() + 1 == most ? "another reason" : reason, 0});
  ++entries_[known->second - 1].count;
  return known->second;
}

std::uint64_t ReasonTable::total() const {
  return std::accumulate(entries_.begin(), entries_.end(), std::uint64_t{0},
                         [](std::uint64_t sum, const Entry& entry) { return sum + entry.count; });
}

void SweepFile::create(const std::string& path, const Study& study, TrialRange range, const std::string& command_line) {
  PartFile file(path + ".part");  // so that NAME.part is whole from its first moment on
  write_provenance(file.file(), {"sweep", study.title, to_toml(study.scenario), command_line});
  write_attribute(file.file(), "study", study.text);
  write_attribute(file.file(), "build", program_identity());
  write_attribute(file.file(), "first_trial", static_cast<std::int64_t>(range.first));
  write_attribute(file.file(), "end_trial", static_cast<std::int64_t>(range.end));
  FixedTexts::create(file.file(), "reasons", "of each kind of reasons why trials are not done the first one",
                     ReasonTable::most);
  FixedTable::create(file.file(), "trials", trial_columns(study), range.size());
  FixedTable::create(file.file(), "referee", verdict_descriptions(), most_verdicts);
  create_summary_tables(file.file(), study);
  file.finish();
}

SweepFile::SweepFile(const std::string& path, const Study& study, TrialRange range, ReasonTable reasons)
    : range_(range),
      file_(PartFile::reopened(path)),
      reasons_(std::move(reasons)),
      reasons_written_(reasons_.entries().size()),
      flushed_(Clock::now()) {
  table_.emplace(file_.file(), "trials", trial_columns(study));
  reason_texts_.emplace(file_.file(), "reasons");
  columns_.resize(study.parameters.size() + study.metrics.size() + 3);
}

void SweepFile::append(const Trial& trial) {
  const std::uint64_t row = trial.index - range_.first;
  if (columns_.front().size() >= rows_at_once || row != row_ + columns_.front().size() ||
      Clock::now() - flushed_ >= std::chrono::seconds(1))
    flush();
  if (columns_.front().empty()) row_ = row;
  auto column = columns_.begin();
  (column++)->push_back(static_cast<double>(trial.index));
  for (const double value : trial.parameters) (column++)->push_back(value);
  for (const double value : trial.metrics) (column++)->push_back(value);
  (column++)->push_back(static_cast<double>(reasons_.code(trial.reason)));
  column->push_back(static_cast<double>(trial.status));
}

void SweepFile::flush() {
  flushed_ = Clock::now();
  if (columns_.front().empty()) return;
  for (; reasons_written_ < reasons_.entries().size(); ++reasons_written_)
    reason_texts_->write(reasons_written_, reasons_.entries()[reasons_written_].example);
  const std::size_t status = columns_.size() - 1;
  for (std::size_t k = 0; k < status; ++k) table_->write(k, row_, columns_[k]);
  // A row is there only once it has a status, and it has one only when all else is on its way to the disk: a kill
  // between the two flushes costs rows, but leaves none that only seem to be there.
  file_.flush();
  table_->write(status, row_, columns_[status]);
  file_.flush();
  for (std::vector<double>& column : columns_) column.clear();
}

void SweepFile::write(const std::vector<RefereeVerdict>& verdicts) {
  const std::size_t count = std::min(verdicts.size(), most_verdicts);
  std::vector<std::vector<double>> columns(verdict_descriptions().size());
  for (std::size_t k = 0; k < count; ++k) {
    const auto& [trial, found, in_loop, halted] = verdicts[k];
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const Disagreement closed = in_loop.closed.value_or(Disagreement{none, none, none});
    auto column = columns.begin();
    for (const double value : {halted ? 2.0 : 1.0, static_cast<double>(trial), found.angle, found.speed, found.t,
                               closed.angle, closed.speed, closed.t, in_loop.parted.value_or(none)})
      (column++)->push_back(value);
  }
  FixedTable table(file_.file(), "referee", verdict_descriptions());
  for (std::size_t k = 0; k < columns.size(); ++k) table.write(k, 0, columns[k]);
}

void SweepFile::finish() {
  flush();
  {
    const SweepReader all(part_path());
    write_summary_tables(file_.file(), summarise(all, {.worst = worst_trials_listed}), all.study());
  }
  table_.reset();
  reason_texts_.reset();
  file_.finish();
}

SweepReader::SweepReader(const std::string& path) : path_(path) {
  try {
    file_ = open_hdf5(path);
    if (read_text_attribute(file_, "kind") != "sweep") throw OutputFault("it is not the result of a sweep");
    scenario_ = read_text_attribute(file_, "scenario");
    build_ = read_text_attribute(file_, "build");
    study_ = parse_study(read_text_attribute(file_, "study"), scenario_, path);
    range_ = {static_cast<std::uint64_t>(read_integer_attribute(file_, "first_trial")),
              static_cast<std::uint64_t>(read_integer_attribute(file_, "end_trial"))};
    reasons_ = read_fixed_texts(file_, "reasons");
    for_each_block({}, [&](const Block& block) {
      std::uint64_t trial = block.first;
      for (const double status : block.status) {
        if (status != 0.0) extend(present_, {trial, trial + 1});
        ++trial;
      }
    });
  } catch (const OutputFault& fault) {
    refuse({path}, fault.what());
  }
}

bool SweepReader::has(std::uint64_t trial) const {
  return std::any_of(present_.begin(), present_.end(),
                     [&](const TrialRange& range) { return range.first <= trial && trial < range.end; });
}

std::string SweepReader::why_not(const std::string& study, const std::string& scenario,
                                 const std::string& build) const {
  if (const auto other = difference(study_.text, study)) return "the study differs in " + *other;
  if (const auto other = difference(scenario_, scenario)) return "the scenario differs in " + *other;
  return build_ == build ? "" : fmt::format("it was made by {}, and this is {}", build_, build);
}
std::string SweepReader::why_not_of(const Study& study) const {
  return why_not(study.text, to_toml(study.scenario), program_identity());
}
std::string SweepReader::why_not_of(const SweepReader& other) const {
  return why_not(other.study_.text, other.scenario_, other.build_);
}

void SweepReader::for_each_block(const std::vector<std::string>& columns,
                                 const std::function<void(const Block&)>& visit) const {
  constexpr std::uint64_t at_once = 1 << 16;
  for (std::uint64_t first = range_.first; first < range_.end; first += at_once) {
    const auto read = [&](const std::string& name) {
      return read_column(file_, "trials/" + name, first - range_.first, std::min(at_once, range_.end - first));
    };
    Block block{first, read("status"), {}};
    for (const std::string& name : columns) block.columns.push_back(read(name));
    visit(block);
  }
}

std::vector<Trial> SweepReader::read(TrialRange range) const {
  std::vector<Trial> trials(range.size());
  const auto each = [&](const std::string& name, auto&& put) {
    const std::vector<double> values = read_column(file_, "trials/" + name, range.first - range_.first, range.size());
    for (std::size_t k = 0; k < trials.size(); ++k) put(trials[k], values[k]);
  };
  each("index", [](Trial& t, double value) { t.index = static_cast<std::uint64_t>(value); });
  for (const UncertainParameter& p : study_.parameters)
    each(p.name, [](Trial& t, double value) { t.parameters.push_back(value); });
  for (const Metric& m : study_.metrics) each(m.name, [](Trial& t, double value) { t.metrics.push_back(value); });
  each("status", [](Trial& t, double value) { t.status = static_cast<TrialStatus>(value); });
  each("reason", [&](Trial& t, double value) {
    const auto code = static_cast<std::size_t>(value);
    if (code > 0) t.reason = reasons_.at(code - 1);
  });
  return trials;
}

std::vector<RefereeVerdict> SweepReader::verdicts() const {
  const auto read = [&](const std::string& name) { return read_column(file_, "referee/" + name); };
  const std::vector<double> judged = read("judged"), trial = read("trial"), angle = read("angle_difference"),
                            speed = read("speed_difference"), t = read("time"),
                            closed_angle = read("closed_angle_difference"),
                            closed_speed = read("closed_speed_difference"), closed_t = read("closed_time"),
                            parted = read("parted");
  std::vector<RefereeVerdict> list;
  for (std::size_t k = 0; k < judged.size() && judged[k] != 0.0; ++k) {
    RefereeVerdict verdict{static_cast<std::uint64_t>(trial[k]), {angle[k], speed[k], t[k]}, {}, judged[k] == 2.0};
    if (!std::isnan(closed_angle[k])) verdict.in_loop.closed = {closed_angle[k], closed_speed[k], closed_t[k]};
    if (!std::isnan(parted[k])) verdict.in_loop.parted = parted[k];
    list.push_back(verdict);
  }
  return list;
}

ReasonTable SweepReader::counted_reasons() const {
  std::vector<std::uint64_t> counts(reasons_.size());
  for_each_block({"reason"}, [&](const Block& block) {
    for (const double code : block.columns.front())
      if (code > 0.0) ++counts.at(static_cast<std::size_t>(code) - 1);
  });
  return {reasons_, counts};
}

}  // namespace wormdrive
