#include "sweep/ensemble.hpp"

#include <algorithm>
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
  /// Trials that somebody makes together, and the turn of the first one to be handed over.
  struct Claim {
    TrialRange trials;
    std::uint64_t turn;
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

  /// The next trials, at most so many, once there is room for them; nothing when there is no more to do.
  std::optional<Claim> claim(std::uint64_t most) {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [&] { return no_more_ || claimed_ + most <= taken_ + window; });
    if (no_more_) return std::nullopt;
    if (portion_.size() == 0) {
      if (const auto more = source_()) {
        portion_ = *more;
      } else {
        stop_claims();
        return std::nullopt;
      }
    }
    const std::uint64_t first = portion_.first, turn = claimed_, count = std::min(most, portion_.size());
    portion_.first += count;
    claimed_ += count;
    return Claim{{first, first + count}, turn};
  }

  void work() {
    try {
      Trials trials(study_);
      while (const auto mine = claim(trials.together())) {
        std::vector<Trial> made = trials(mine->trials);
        const std::lock_guard lock(mutex_);
        for (std::size_t k = 0; k < made.size(); ++k) done_[(mine->turn + k) % window] = std::move(made[k]);
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
