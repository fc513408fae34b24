#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "description/diagnostics.hpp"
#include "output/hdf5/read_ahead.hpp"
#include "sweep/file/sweep_file.hpp"
#include "sweep/study/load_study.hpp"

namespace wormdrive {

SweepReader::SweepReader(const std::string& path, bool while_written) : path_(path) {
  try {
    read_ahead(path, while_written);
    file_ = while_written ? open_hdf5_while_written(path) : open_hdf5(path);
    if (const std::string kind = read_text_attribute(file_, "kind"); kind != "sweep")
      throw OutputFault(fmt::format("it is a result of '{}', not of a sweep; wormdrive report shows it", kind));
    const std::string scenario = read_text_attribute(file_, "scenario");
    study_ = parse_study(read_text_attribute(file_, "study"), scenario, path);
    origin_ = {study_.text, scenario, read_text_attribute(file_, "build")};
    stored_ = check_sweep(file_, study_);
    for_each_block({}, [&](const Block& block) {
      std::uint64_t trial = block.first;
      for (const double status : block.status) {
        if (status != 0.0) extend(present_, {trial, trial + 1});
        ++trial;
      }
    });
    reasons_ = read_fixed_texts(file_, "reasons");  // after the trials, for they were written before these
  } catch (const OutputFault& fault) {
    reject({path}, fault.what());
  }
}

bool SweepReader::has(std::uint64_t trial) const {
  return std::any_of(present_.begin(), present_.end(),
                     [&](const TrialRange& range) { return range.first <= trial && trial < range.end; });
}

std::string SweepReader::why_not_of(const Study& study) const { return why_not_beside(origin_, origin_of(study)); }
std::string SweepReader::why_not_of(const SweepReader& other) const {
  return why_not_beside(origin_, other.origin_, "that one by");
}

void SweepReader::for_each_block(TrialRange range, const std::vector<std::string>& columns,
                                 const std::function<void(const Block&)>& visit) const {
  for_each_block(range, "status", [&](std::uint64_t first, const std::vector<double>& status) {
    Block block{first, status, {}};
    for (const std::string& name : columns)
      block.columns.push_back(stored_->trials.column(name).values(first - stored_->range.first, status.size()));
    visit(block);
  });
}

void SweepReader::for_each_block(TrialRange range, const std::string& column,
                                 const std::function<void(std::uint64_t, const std::vector<double>&)>& visit) const {
  constexpr std::uint64_t at_once = 1 << 16;
  for (std::uint64_t first = range.first; first < range.end; first += at_once)
    visit(first,
          stored_->trials.column(column).values(first - stored_->range.first, std::min(at_once, range.end - first)));
}

std::vector<Trial> SweepReader::read(TrialRange range) const {
  std::vector<Trial> trials(range.size());
  const auto each = [&](const std::string& name, auto&& put) {
    const std::uint64_t row = range.first - stored_->range.first;
    const std::vector<double> values = stored_->trials.column(name).values(row, range.size());
    for (std::size_t k = 0; k < trials.size(); ++k) put(trials[k], values[k]);
  };
  each("index", [this](Trial& t, double value) {
    t.index = static_cast<std::uint64_t>(value);
    t.parameters.reserve(study_.parameters.size());
    t.metrics.reserve(study_.metrics.size());
  });
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
  const auto read = [&](const std::string& name) { return stored_->referee.column(name).values(); };
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
  std::vector<ReasonTable::Entry> entries;
  for (const std::string& reason : reasons_) entries.push_back({reason, 0, ReasonTable::no_trial});
  for_each_block({"reason"}, [&](const Block& block) {
    for (std::size_t row = 0; row < block.status.size(); ++row) {
      const auto code = static_cast<std::size_t>(block.columns.front()[row]);
      if (block.status[row] == 0.0 || code == 0) continue;
      ReasonTable::Entry& entry = entries.at(code - 1);
      ++entry.count;
      entry.first = std::min(entry.first, block.first + row);
    }
  });
  return ReasonTable(std::move(entries));
}

}  // namespace wormdrive
