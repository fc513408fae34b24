#include "sweep/ensemble.hpp"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <optional>
#include <thread>

namespace wormdrive {
namespace {

/// Trials that are done before the one that is to be handed over next wait here, so many at most.
constexpr std::uint64_t window = 4096;

class Ensemble {
 public:
  Ensemble(const Study& study, const TrialSource& source) : study_(study), source_(source) {}

  void run(unsigned threads, const std::function<bool(Trial)>& take, const std::function<bool()>& stop) {
    {
      std::vector<std::jthread> workers;
      const Stopper stop_on_the_way_out{*this};  // whatever take() throws; then the workers are joined
      for (unsigned k = 0; k < threads; ++k) workers.emplace_back([this] { work(); });
      hand_over(take, stop);
    }
    if (fault_) std::rethrow_exception(fault_);
  }

 private:
  struct Stopper {
    Ensemble& ensemble;
    ~Stopper() { ensemble.halt(); }
  };
  /// A trial that somebody makes, and its turn to be handed over.
  struct Claim {
    std::uint64_t index, turn;
  };

  void halt() {
    const std::lock_guard lock(mutex_);
    stop_claims();
  }
  void stop_claims() {
    no_more_ = true;
    room_.notify_all();
    news_.notify_all();
  }

  /// The next trial, once there is room for it; nothing when there is no more to do.
  std::optional<Claim> claim() {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [this] { return no_more_ || claimed_ < taken_ + window; });
    if (no_more_) return std::nullopt;
    if (portion_.size() == 0) {
      if (const auto more = source_()) {
        portion_ = *more;
      } else {
        stop_claims();
        return std::nullopt;
      }
    }
    return Claim{portion_.first++, claimed_++};
  }

  void work() {
    try {
      Trials trials(study_);
      while (const auto mine = claim()) {
        Trial trial = trials(mine->index);
        const std::lock_guard lock(mutex_);
        done_[mine->turn % window] = std::move(trial);
        if (mine->turn == taken_) news_.notify_one();
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!fault_) fault_ = std::current_exception();
      stop_claims();
    }
  }

  void hand_over(const std::function<bool(Trial)>& take, const std::function<bool()>& stop) {
    for (std::unique_lock lock(mutex_);;) {
      if (!no_more_ && stop()) stop_claims();
      std::optional<Trial>& trial = done_[taken_ % window];
      if (trial) {
        Trial ready = std::move(*trial);
        trial.reset();
        ++taken_;
        room_.notify_one();
        lock.unlock();
        if (!take(std::move(ready))) return;
        lock.lock();
      } else if (fault_ || (no_more_ && taken_ == claimed_)) {
        return;
      } else {
        news_.wait_for(lock, std::chrono::milliseconds(100));
      }
    }
  }

  const Study& study_;
  const TrialSource& source_;
  std::mutex mutex_;
  std::condition_variable room_, news_;
  TrialRange portion_;                     ///< of the source, what nobody has claimed
  std::uint64_t claimed_ = 0, taken_ = 0;  ///< trials claimed, handed over
  bool no_more_ = false;                   ///< to claim
  std::exception_ptr fault_;
  std::vector<std::optional<Trial>> done_{window};
};

}  // namespace

void run_ensemble(const Study& study, const TrialSource& source, unsigned threads,
                  const std::function<bool(Trial)>& take, const std::function<bool()>& stop) {
  Ensemble(study, source).run(threads, take, stop);
}

}  // namespace wormdrive
