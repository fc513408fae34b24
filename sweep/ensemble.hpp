#pragma once
#include <functional>
#include <optional>

#include "sweep/trial.hpp"
#include "sweep/trial_range.hpp"

namespace wormdrive {

/// Gives the trials that are to be made, portion by portion in rising order; nothing when there are no more.
using TrialSource = std::function<std::optional<TrialRange>()>;

/// Makes trials on several threads, each with a solver of its own, and hands each over on the calling thread as soon as
/// it is done, in no order: one that takes long holds back no other. Before trials are handed over, and at least ten
/// times a second, it asks stop(); when told so it finishes the trials that have begun, hands them over and returns. As
/// trials are begun in the order of the source, every one before the last one is then there.
/// Trials that gain from it are made several at once, in the lanes of a register.
/// The source is asked by one thread at a time. Memory does not depend on the number of trials.
void run_ensemble(const Study& study, const TrialSource& source, unsigned threads,
                  const std::function<void(Trial)>& take, const std::function<bool()>& stop);

}  // namespace wormdrive
