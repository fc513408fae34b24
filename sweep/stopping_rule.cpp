#include "sweep/stopping_rule.hpp"

#include <algorithm>

#include "sweep/summary/statistics.hpp"

namespace wormdrive {

StoppingRule::StoppingRule(const Study& study) {
  for (const Threshold& threshold : study.thresholds) {
    if (threshold.until == 0.0) continue;
    const std::size_t place = study.place_of(threshold.metric);
    watched_.push_back({threshold, place, study.metrics[place]});
  }
  if (watched_.empty()) return;
  missed_.resize(watched_.size());
  constexpr std::uint64_t first = 100;
  for (std::uint64_t end = first; end < study.trials(); end += end / 10) looks_.push_back(end);
}

void StoppingRule::count(const Trial& trial, Counts& counts) const {
  const auto look = std::upper_bound(looks_.begin(), looks_.end(), trial.index);
  if (look == looks_.end()) return;
  auto at = counts.begin() + (look - looks_.begin()) * static_cast<std::ptrdiff_t>(numbers_per_look());
  const bool done = trial.status == TrialStatus::done;
  ++*at++;
  *at++ += !done;
  for (const Watched& one : watched_)
    *at++ += done && one.threshold.missed_by(one.metric.counted(trial.metrics[one.place]));
}

void StoppingRule::look(std::span<const std::uint64_t> counts) {
  for (; !end_ && next_ < looks_.size(); ++next_) {
    const std::uint64_t end = looks_[next_], begin = next_ == 0 ? 0 : looks_[next_ - 1];
    const auto due = counts.subspan(next_ * numbers_per_look(), numbers_per_look());
    if (due[0] < end - begin) return;
    failed_ += due[1];
    for (std::size_t k = 0; k < missed_.size(); ++k) missed_[k] += due[2 + k];
    if (is_enough(end)) end_ = end;
  }
}

bool StoppingRule::is_enough(std::uint64_t trials) const {
  for (std::size_t k = 0; k < watched_.size(); ++k) {
    const SampleEstimate share = probability(missed_[k], trials);
    if (missed_[k] == 0 || 0.5 * (share.high - share.low) > watched_[k].threshold.until * share.value) return false;
  }
  return true;
}

}  // namespace wormdrive
