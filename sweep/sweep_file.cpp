#include "sweep/sweep_file.hpp"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "scenarios/faults.hpp"
#include "scenarios/write_scenario.hpp"
#include "sweep/load_study.hpp"

namespace wormdrive {
namespace {

constexpr std::size_t rows_at_once = 4096;  ///< one chunk of the file

std::vector<ColumnDescription> descriptions(const Study& study) {
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
  list.push_back(std::move(status));
  list.push_back({"reason", "1", "why it is not done: k stands for the attribute reason_k of the table, 0 for none"});
  return list;
}

}  // namespace

std::size_t ReasonTable::code(const std::string& reason) {
  constexpr std::size_t most = 100;
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

SweepFile::SweepFile(const std::string& path, const Study& study, TrialRange range, const std::string& command_line)
    : file_(path) {
  write_provenance(file_.file(), {"sweep", study.title, to_toml(study.scenario), command_line});
  write_attribute(file_.file(), "study", study.text);
  write_attribute(file_.file(), "build", build_description());
  write_attribute(file_.file(), "first_trial", static_cast<std::int64_t>(range.first));
  write_attribute(file_.file(), "end_trial", static_cast<std::int64_t>(range.end));
  table_.emplace(file_.file(), "trials", descriptions(study));
  write_attribute(table_->group(), "safe_rows", std::int64_t{0});
  columns_.resize(study.parameters.size() + study.metrics.size() + 3);
  file_.keep();
  flushed_ = Clock::now();
}

void SweepFile::append(const Trial& trial) {
  auto column = columns_.begin();
  (column++)->push_back(static_cast<double>(trial.index));
  for (const double value : trial.parameters) (column++)->push_back(value);
  for (const double value : trial.metrics) (column++)->push_back(value);
  (column++)->push_back(static_cast<double>(trial.status));
  column->push_back(static_cast<double>(reasons_.code(trial.reason)));
  if (column->size() >= rows_at_once || Clock::now() - flushed_ >= std::chrono::seconds(1)) flush();
}

void SweepFile::flush() {
  for (; reasons_written_ < reasons_.entries().size(); ++reasons_written_)
    write_attribute(table_->group(), fmt::format("reason_{}", reasons_written_ + 1),
                    reasons_.entries()[reasons_written_].example);
  table_->append(columns_);
  rows_ += static_cast<std::int64_t>(columns_.front().size());
  for (std::vector<double>& column : columns_) column.clear();
  // Rows are counted only once they are on their way to the disk: a kill between the two flushes costs rows, but leaves
  // none that only seem to be there.
  file_.flush();
  rewrite_attribute(table_->group(), "safe_rows", rows_);
  file_.flush();
  flushed_ = Clock::now();
}

void SweepFile::finish() {
  flush();
  table_.reset();
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
    const Hdf5Handle table(H5Gopen2(file_, "trials", H5P_DEFAULT), H5Gclose, "it has no group 'trials'");
    rows_ = static_cast<std::uint64_t>(read_integer_attribute(table, "safe_rows"));
    for (std::size_t k = 1; has_attribute(table, fmt::format("reason_{}", k)); ++k)
      reasons_.push_back(read_text_attribute(table, fmt::format("reason_{}", k)));
  } catch (const OutputFault& fault) {
    refuse({path}, fault.what());
  }
}

std::string SweepReader::why_not(const std::string& study, const std::string& scenario,
                                 const std::string& build) const {
  if (const auto other = difference(study_.text, study)) return "the study differs in " + *other;
  if (const auto other = difference(scenario_, scenario)) return "the scenario differs in " + *other;
  return build_ == build ? "" : fmt::format("it was made by {}, and this is {}", build_, build);
}
std::string SweepReader::why_not_of(const Study& study) const {
  return why_not(study.text, to_toml(study.scenario), build_description());
}
std::string SweepReader::why_not_of(const SweepReader& other) const {
  return why_not(other.study_.text, other.scenario_, other.build_);
}

std::vector<double> SweepReader::column(const std::string& name) const {
  return read_column(file_, "trials/" + name, 0, rows_);
}

std::vector<Trial> SweepReader::read(std::uint64_t row, std::uint64_t count) const {
  std::vector<Trial> trials(count);
  const auto each = [&](const std::string& name, auto&& put) {
    const std::vector<double> values = read_column(file_, "trials/" + name, row, count);
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

void copy_rows(const SweepReader& from, SweepFile& to) {
  for (std::uint64_t row = 0; row < from.rows(); row += rows_at_once)
    for (const Trial& trial : from.read(row, std::min<std::uint64_t>(rows_at_once, from.rows() - row)))
      to.append(trial);
  to.flush();
}

}  // namespace wormdrive
