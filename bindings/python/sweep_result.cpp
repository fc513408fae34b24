#include "bindings/python/sweep_result.hpp"

#include <algorithm>
#include <stdexcept>

#include "sweep/ensemble.hpp"
#include "sweep/referee.hpp"
#include "sweep/stopping_rule.hpp"

namespace wormdrive {

SweepResult::SweepResult(Study study)
    : study_(std::move(study)), descriptions_(trial_columns(study_)), values_(descriptions_.size()) {}

void SweepResult::run(unsigned threads, const std::function<void()>& between) {
  std::optional<TrialRange> all = TrialRange{0, study_.trials()};
  for (std::vector<double>& column : values_) column.resize(all->size());
  StoppingRule rule(study_);
  StoppingRule::Counts counts = rule.none();
  run_ensemble(
      study_, [&] { return std::exchange(all, std::nullopt); }, threads,
      [&](const Trial& trial) {
        between();
        take(trial);
        rule.take(trial, counts);
      },
      [&] { return rule.end().has_value(); });
  if (rule.end()) end_before(*rule.end());
  const std::vector<std::size_t> numbers = reasons_.put_in_order();
  for (double& number : *(values_.rbegin() + 1))
    number = static_cast<double>(numbers[static_cast<std::size_t>(number)]);
}

void SweepResult::end_before(std::size_t row) {
  for (std::vector<double>& column : values_) column.resize(row);
  ReasonTable left;  // of threads that were ahead there may be reasons that are not
  std::vector<double>& codes = *(values_.rbegin() + 1);
  for (std::size_t k = 0; k < row; ++k)
    if (codes[k] > 0.0) codes[k] = static_cast<double>(left.code(trial(k).reason, k));
  reasons_ = std::move(left);
}

void SweepResult::restore(std::vector<std::vector<double>> columns, const std::vector<std::string>& reasons) {
  if (columns.size() != values_.size()) throw std::invalid_argument("these are not the trials of this study");
  values_ = std::move(columns);
  std::vector<ReasonTable::Entry> entries;
  for (const std::string& reason : reasons) entries.push_back({reason, 0, ReasonTable::no_trial});
  const std::vector<double>& codes = values_[values_.size() - 2];
  for (std::size_t trial = 0; trial < codes.size(); ++trial) {
    if (codes[trial] == 0.0) continue;
    ReasonTable::Entry& entry = entries.at(static_cast<std::size_t>(codes[trial]) - 1);
    ++entry.count;
    entry.first = std::min<std::uint64_t>(entry.first, trial);
  }
  reasons_ = ReasonTable(std::move(entries));
}

void SweepResult::take(const Trial& trial) {
  auto column = values_.begin();
  const auto put = [&](double value) { (*column++)[trial.index] = value; };
  put(static_cast<double>(trial.index));
  for (const double value : trial.parameters) put(value);
  for (const double value : trial.metrics) put(value);
  put(static_cast<double>(reasons_.code(trial.reason, trial.index)));
  put(static_cast<double>(trial.status));
}

Trial SweepResult::trial(std::size_t row) const {
  auto column = values_.begin();
  const auto next = [&] { return (*column++)[row]; };
  Trial trial;
  trial.index = static_cast<std::uint64_t>(next());
  for (std::size_t k = 0; k < study_.parameters.size(); ++k) trial.parameters.push_back(next());
  for (std::size_t k = 0; k < study_.metrics.size(); ++k) trial.metrics.push_back(next());
  if (const double code = next(); code > 0.0)
    trial.reason = reasons_.entries().at(static_cast<std::size_t>(code) - 1).example;
  trial.status = static_cast<TrialStatus>(next());
  return trial;
}

std::vector<std::string> SweepResult::reasons() const {
  std::vector<std::string> list;
  for (const ReasonTable::Entry& entry : reasons_.entries()) list.push_back(entry.example);
  return list;
}

void SweepResult::write(const std::string& name, const std::string& command_line, std::size_t judged, unsigned threads,
                        Replace replace) const {
  const TrialRange all{0, values_.front().size()};
  const std::string path = followed(name);
  const OutputLock lock(path);
  SweepFile::create(path, study_, all, command_line, replace);
  SweepFile file(path, study_, all, {}, replace);
  for (std::size_t row = 0; row < values_.front().size(); ++row) file.append(trial(row));
  if (judged > 0 && study_.scenario.run.solver != SolverKind::cvode) {
    file.flush();
    const SweepReader sweep(file.part_path());
    file.write(referee(sweep, threads, [&, count = std::size_t{0}]() mutable { return count++ >= judged; }));
  }
  file.finish();
}

}  // namespace wormdrive
