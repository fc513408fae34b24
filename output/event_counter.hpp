#pragma once
#include <array>
#include <cstddef>
#include <optional>

#include "output/trajectory.hpp"

namespace wormdrive {

/// Counts the events of a run of which no rows are kept: those that a TrajectoryRecorder would find.
template <class System>
class EventCounter {
 public:
  using Instant = typename System::Instant;

  void operator()(const System& system, const Instant& now) {
    if (latest_ && latest_->t == now.t && !(latest_->mode == now.mode)) count(system, now);
    latest_ = now;
  }
  /// Counts flank changes that were seen elsewhere.
  void changed_flank(long times) { events_[static_cast<std::size_t>(EventKind::flank_change)] += times; }
  /// By EventKind.
  const std::array<long, event_kind_count>& events() const { return events_; }
  /// What the drive shows at the latest instant; there has to be one.
  Observation end(const System& system) const { return system.observe(*latest_); }

 private:
  void count(const System& system, const Instant& now) {
    ++events_[static_cast<std::size_t>(kind_of(system.observe(*latest_), system.observe(now)))];
  }

  std::optional<Instant> latest_;
  std::array<long, event_kind_count> events_{};
};

}  // namespace wormdrive
