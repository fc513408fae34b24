#pragma once
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "events/simulation_failure.hpp"

namespace wormdrive {

/// When events come too fast to be mechanics.
struct ChatterLimit {
  int events = 100;      ///< this many guard events ...
  double window = 1e-6;  ///< ... within this time [s] stop the run
};

/// Remembers the latest guard events of a run, stops it when they pile up, and tells what led to a halt. Its place is
/// allocated once.
class EventLog {
 public:
  explicit EventLog(ChatterLimit limit = {}) : limit_(limit) {
    latest_.reserve(static_cast<std::size_t>(limit_.events));
  }

  /// Notes an event at a guard whose name lasts; throws SimulationFailure when there were more than the limit allows
  /// within its window.
  void count(double t, std::string_view guard, Mode before, Mode after);

  /// A SimulationFailure with time, mode, the latest events and the reason.
  SimulationFailure halt(double t, Mode mode, const std::string& reason) const;

 private:
  struct Entry {
    double t;
    std::string_view guard;
    Mode before, after;
  };
  /// The k-th of those that are remembered, the latest being the last.
  const Entry& entry(std::size_t k) const { return latest_[(oldest_ + k) % latest_.size()]; }
  SimulationFailure chatter() const;

  ChatterLimit limit_;
  long total_ = 0;
  std::vector<Entry> latest_;  ///< a ring once it is full ...
  std::size_t oldest_ = 0;     ///< ... that begins here
};

}  // namespace wormdrive
