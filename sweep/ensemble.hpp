#pragma once
#include <functional>
#include <optional>

#include "sweep/trial.hpp"
#include "sweep/trial_range.hpp"

namespace wormdrive {

/// Gives the trials that are to be made, portion by portion in rising order; nothing when there are no more.
using TrialSource = std::function<std::optional<TrialRange>()>;

/// Makes trials on several threads, each with a solver of its own, and hands them over in the order of the source on
/// the calling thread, whatever their number. take() returns whether to go on: if not, it has had its last trial.
/// Between two trials it asks stop(); when told so it finishes the trials that have begun, hands them over and returns.
/// Trials that gain from it are made several at once, in the lanes of a register.
/// The source is asked by one thread at a time. Memory does not depend on the number of trials.
void run_ensemble(const Study& study, const TrialSource& source, unsigned threads,
                  const std::function<bool(Trial)>& take, const std::function<bool()>& stop);

}  // namespace wormdrive
