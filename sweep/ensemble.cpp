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

/// Trials that are done and wait for being handed over, so many at most.
constexpr std::size_t window = 1 << 16;
/// So many are worth waking the thread that takes them; fewer wait a moment.
constexpr std::size_t worth_waking = 256;
constexpr std::chrono::milliseconds moment(10);

class Ensemble {
 public:
  Ensemble(const Study& study, const TrialSource& source) : study_(study), source_(source) {}

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
    stop_claims();
  }
  void stop_claims() {
    no_more_ = true;
    room_.notify_all();
    news_.notify_all();
  }

  /// The next trials, at most so many, once there is room for them; nothing when there is no more to do.
  std::optional<TrialRange> claim(std::uint64_t most) {
    std::unique_lock lock(mutex_);
    room_.wait(lock, [&] { return no_more_ || done_.size() < window; });
    if (no_more_) return std::nullopt;
    if (portion_.size() == 0) {
      if (const auto more = source_()) {
        portion_ = *more;
      } else {
        stop_claims();
        return std::nullopt;
      }
    }
    const std::uint64_t first = portion_.first, count = std::min(most, portion_.size());
    portion_.first += count;
    in_work_ += count;
    return TrialRange{first, first + count};
  }

  void work() {
    try {
      Trials trials(study_);
      while (const auto mine = claim(trials.together()))
        trials.make(*mine, [this](Trial trial) { put(std::move(trial)); });
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!fault_) fault_ = std::current_exception();
      stop_claims();
    }
  }
  void put(Trial trial) {
    const std::lock_guard lock(mutex_);
    done_.push_back(std::move(trial));
    --in_work_;
    if (done_.size() == worth_waking || ended()) news_.notify_one();
  }
  bool ended() const { return fault_ || (no_more_ && in_work_ == 0); }

  void hand_over(const std::function<void(Trial)>& take, const std::function<bool()>& stop) {
    for (bool last = false; !last;) {
      if (stop()) halt();
      std::vector<Trial> ready;
      {
        std::unique_lock lock(mutex_);
        news_.wait_for(lock, moment, [this] { return done_.size() >= worth_waking || ended(); });
        ready.swap(done_);
        last = ended();
      }
      room_.notify_all();
      for (Trial& trial : ready) take(std::move(trial));
    }
  }

  const Study& study_;
  const TrialSource& source_;
  std::mutex mutex_;
  std::condition_variable room_, news_;
  TrialRange portion_;         ///< of the source, what nobody has claimed
  std::vector<Trial> done_;    ///< and not handed over yet
  std::uint64_t in_work_ = 0;  ///< trials that somebody makes
  bool no_more_ = false;       ///< to claim
  std::exception_ptr fault_;
};

}  // namespace

void run_ensemble(const Study& study, const TrialSource& source, unsigned threads,
                  const std::function<void(Trial)>& take, const std::function<bool()>& stop) {
  Ensemble(study, source).run(threads, take, stop);
}

}  // namespace wormdrive
