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
  for (std::uint64_t end = first; end < study.trials(); end += end / 10)
    looks_.push_back({end, 0, 0, std::vector<std::uint64_t>(watched_.size())});
}

void StoppingRule::take(const Trial& trial) {
  const auto look = std::upper_bound(looks_.begin(), looks_.end(), trial.index,
                                     [](std::uint64_t index, const Look& one) { return index < one.end; });
  if (end_ || look == looks_.end()) return;
  ++look->made;
  look->failed += trial.status != TrialStatus::done;
  for (std::size_t k = 0; k < watched_.size() && trial.status == TrialStatus::done; ++k) {
    const Watched& one = watched_[k];
    look->missed[k] += one.threshold.missed_by(one.metric.counted(trial.metrics[one.place]));
  }
  for (; !end_ && next_ < looks_.size(); ++next_) {
    const Look& due = looks_[next_];
    if (due.made < due.end - (next_ == 0 ? 0 : looks_[next_ - 1].end)) return;
    failed_ += due.failed;
    for (std::size_t k = 0; k < missed_.size(); ++k) missed_[k] += due.missed[k];
    if (is_enough(due.end)) end_ = due.end;
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
