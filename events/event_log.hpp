#pragma once
#include <deque>
#include <string>

#include "events/simulation_failure.hpp"

namespace wormdrive {

/// When events come too fast to be mechanics.
struct ChatterLimit {
  int events = 100;      ///< this many guard events ...
  double window = 1e-6;  ///< ... within this time [s] stop the run
};

/// Remembers the latest guard events of a run, stops it when they pile up, and tells what led to a halt.
class EventLog {
 public:
  explicit EventLog(ChatterLimit limit = {}) : limit_(limit) {}

  /// Notes an event; throws SimulationFailure when there were more than the limit allows within its window.
  void count(double t, const std::string& guard, Mode before, Mode after);

  /// A SimulationFailure with time, mode, the latest events and the reason.
  SimulationFailure halt(double t, Mode mode, const std::string& reason) const;

 private:
  struct Entry {
    double t;
    std::string guard;
    Mode before, after;
  };
  SimulationFailure chatter() const;

  ChatterLimit limit_;
  long total_ = 0;
  std::deque<Entry> latest_;
};

}  // namespace wormdrive
