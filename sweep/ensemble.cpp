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
  Ensemble(const Study& study, TrialRange range)
      : study_(study), end_(range.end), next_(range.first), taken_(range.first) {}

  void run(unsigned threads, const std::function<void(Trial)>& take, const std::function<bool()>& stop) {
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

  void halt() {
    const std::lock_guard lock(mutex_);
    stopped_ = true;
    room_.notify_all();
    news_.notify_all();
  }

  /// The next trial, once there is room for it; nothing when there is no more to do.
  std::optional<std::uint64_t> claim() {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [this] { return stopped_ || next_ == end_ || next_ < taken_ + window; });
    if (stopped_ || next_ == end_) return std::nullopt;
    return next_++;
  }

  void work() {
    try {
      Trials trials(study_);
      while (const auto index = claim()) {
        Trial trial = trials(*index);
        const std::lock_guard lock(mutex_);
        done_[*index % window] = std::move(trial);
        if (*index == taken_) news_.notify_one();
      }
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!fault_) fault_ = std::current_exception();
      stopped_ = true;
      room_.notify_all();
      news_.notify_all();
    }
  }

  void hand_over(const std::function<void(Trial)>& take, const std::function<bool()>& stop) {
    for (std::unique_lock lock(mutex_);;) {
      if (!stopped_ && stop()) {
        stopped_ = true;
        room_.notify_all();
      }
      std::optional<Trial>& trial = done_[taken_ % window];
      if (trial) {
        Trial ready = std::move(*trial);
        trial.reset();
        ++taken_;
        room_.notify_one();
        lock.unlock();
        take(std::move(ready));
        lock.lock();
      } else if (taken_ == end_ || fault_ || (stopped_ && taken_ == next_)) {
        return;
      } else {
        news_.wait_for(lock, std::chrono::milliseconds(100));
      }
    }
  }

  const Study& study_;
  std::uint64_t end_;
  std::mutex mutex_;
  std::condition_variable room_, news_;
  std::uint64_t next_, taken_;  ///< first one that nobody has begun, that is not handed over
  bool stopped_ = false;
  std::exception_ptr fault_;
  std::vector<std::optional<Trial>> done_{window};
};

}  // namespace

void run_ensemble(const Study& study, TrialRange range, unsigned threads, const std::function<void(Trial)>& take,
                  const std::function<bool()>& stop) {
  Ensemble(study, range).run(threads, take, stop);
}

}  // namespace wormdrive
