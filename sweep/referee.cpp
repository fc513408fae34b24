#include "sweep/referee.hpp"

#include <algorithm>
#include <exception>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "events/simulation_failure.hpp"
#include "sweep/study/keyed_permutation.hpp"

namespace wormdrive {
namespace {

/// The trials that are done, in random order.
class Sample {
 public:
  explicit Sample(const SweepReader& sweep)
      : sweep_(sweep), order_(sweep.range().size(), sweep.study().seed, referee_key) {}

  std::optional<std::uint64_t> next() {
    while (at_ < sweep_.range().size()) {
      const std::uint64_t trial = sweep_.range().first + order_(at_++);
      if (sweep_.has(trial) && sweep_.read({trial, trial + 1}).front().status == TrialStatus::done) return trial;
    }
    return std::nullopt;
  }

 private:
  static constexpr std::uint64_t referee_key = std::uint64_t{1} << 32;  ///< no parameter has it
  const SweepReader& sweep_;
  KeyedPermutation order_;
  std::uint64_t at_ = 0;
};

/// CVODE's run with the controller in the loop costs as much again: of so many trials one has it.
constexpr std::size_t one_in_the_loop = 4;

RefereeVerdict judged(Trials& trials, std::uint64_t trial, std::size_t place) {
  RefereeVerdict verdict{trial, {}, {}, false};
  try {
    const Scenario& scenario = trials.scenario(trial);
    verdict.found = cross_check(scenario);
    if (scenario.control && place % one_in_the_loop == 0) verdict.in_loop = cross_check_in_the_loop(scenario);
  } catch (const SimulationFailure&) {
    verdict.halted = true;
  } catch (const SolverFault&) {  // before the run began
    verdict.halted = true;
  }
  return verdict;
}

}  // namespace

std::vector<RefereeVerdict> referee(const SweepReader& sweep, unsigned threads, const std::function<bool()>& enough) {
  Sample sample(sweep);
  std::vector<RefereeVerdict> verdicts;
  std::size_t begun = 0;
  std::exception_ptr fault;
  std::mutex mutex;
  const auto work = [&] {
    try {
      Trials trials(sweep.study());
      for (;;) {
        std::unique_lock lock(mutex);
        if (fault || begun == most_verdicts) return;
        const auto trial = sample.next();
        if (!trial || enough()) return;
        const std::size_t place = begun++;
        verdicts.resize(begun);
        lock.unlock();
        const RefereeVerdict verdict = judged(trials, *trial, place);
        lock.lock();
        verdicts[place] = verdict;
      }
    } catch (...) {
      const std::lock_guard lock(mutex);
      fault = std::current_exception();
    }
  };
  {
    std::vector<std::jthread> workers;
    for (unsigned k = 0; k < threads; ++k) workers.emplace_back(work);
  }
  if (fault) std::rethrow_exception(fault);
  return verdicts;
}

}  // namespace wormdrive
