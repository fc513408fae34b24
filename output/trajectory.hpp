#pragma once
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "core/observation.hpp"

namespace wormdrive {

/// One time of a run.
struct Row {
  double t;  ///< [s]
  Observation at;
};

/// What a change of mode means to the drive.
enum class EventKind : std::int8_t {
  break_away,    ///< starts from rest
  stop,          ///< comes to rest
  reversal,      ///< passes through zero speed into the other direction
  flank_change,  ///< the other flank takes the load, direction unchanged
};

constexpr EventKind kind_of(Mode before, Mode after) {
  if (before.motion == Motion::stuck) return EventKind::break_away;
  if (after.motion == Motion::stuck) return EventKind::stop;
  return before.motion != after.motion ? EventKind::reversal : EventKind::flank_change;
}

constexpr std::string_view name(EventKind kind) {
  switch (kind) {
    case EventKind::break_away: return "break_away";
    case EventKind::stop: return "stop";
    case EventKind::reversal: return "reversal";
    case EventKind::flank_change: return "flank_change";
  }
  return "";
}

/// A change of mode with both its sides.
struct Event {
  double t;  ///< [s]
  Observation before, after;

  EventKind kind() const { return kind_of(before.mode, after.mode); }
};

/// A run in memory: rows at strictly increasing times, right-continuous; left limits stand in the events.
struct Trajectory {
  std::vector<Row> rows;
  std::vector<Event> events;
};

/// Records a run: folds the two sides of an event into one row and one event.
class TrajectoryRecorder {
 public:
  template <class System>
  void operator()(const System& system, const typename System::Instant& now) {
    take({now.t, system.observe(now)});
  }
  const Trajectory& trajectory() const { return trajectory_; }

  /// Hands over the rows and events that are final and forgets them; the latest row may still change and stays
  /// until the recorder is closed.
  Trajectory drain() {
    Trajectory done = std::exchange(trajectory_, {});
    if (!closed_ && !done.rows.empty()) {
      trajectory_.rows.push_back(done.rows.back());
      done.rows.pop_back();
    }
    return done;
  }
  /// No more rows will come.
  void close() { closed_ = true; }

 private:
  void take(const Row& row) {
    auto& rows = trajectory_.rows;
    if (!rows.empty() && rows.back().t == row.t) {
      if (!(rows.back().at.mode == row.at.mode)) trajectory_.events.push_back({row.t, rows.back().at, row.at});
      rows.back() = row;
    } else {
      rows.push_back(row);
    }
  }
  Trajectory trajectory_;
  bool closed_ = false;
};

}  // namespace wormdrive
