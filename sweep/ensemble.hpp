#pragma once
#include <cstdint>
#include <functional>

#include "sweep/trial.hpp"

namespace wormdrive {

/// Trials of one process: first <= index < end.
struct TrialRange {
  std::uint64_t first{}, end{};
  std::uint64_t size() const { return end - first; }
};

/// Makes trials on several threads, each with a solver of its own, and hands them over in the order of their indices on
/// the calling thread, whatever their number. Between two trials it asks stop(); when told so it finishes the trials
/// that have begun, hands them over and returns. Memory does not depend on the number of trials.
void run_ensemble(const Study& study, TrialRange range, unsigned threads, const std::function<void(Trial)>& take,
                  const std::function<bool()>& stop);

}  // namespace wormdrive
