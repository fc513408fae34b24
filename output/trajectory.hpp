#pragma once
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string_view>
#include <utility>
#include <vector>

#include "core/elastic/observation.hpp"

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
  // of elastic teeth only, whose worm and gear may each start, stop and reverse
  impact,           ///< a flank touches; of rigid teeth, the gear hits a hard stop
  opening,          ///< the flanks part
  gear_break_away,  ///< the gear starts from rest
  gear_stop,        ///< the gear comes to rest
  gear_reversal,    ///< the gear passes through zero speed
};
inline constexpr EventKind event_kinds[] = {EventKind::break_away,      EventKind::stop,      EventKind::reversal,
                                            EventKind::flank_change,    EventKind::impact,    EventKind::opening,
                                            EventKind::gear_break_away, EventKind::gear_stop, EventKind::gear_reversal};
inline constexpr std::size_t event_kind_count = std::size(event_kinds);

constexpr EventKind kind_of(Mode before, Mode after) {
  if (before.motion == Motion::stuck) return EventKind::break_away;
  if (after.motion == Motion::stuck) return EventKind::stop;
  return before.motion != after.motion ? EventKind::reversal : EventKind::flank_change;
}
/// Of several changes at once the teeth's names the event, then the worm's; an impact on a stop names itself.
constexpr EventKind kind_of(const Observation& before, const Observation& after) {
  constexpr std::size_t impulse = StateLayout<EffectList<double>>::first<HardStops<double>>();
  if (before.states[impulse] != after.states[impulse]) return EventKind::impact;
  if (!before.teeth || !after.teeth) return kind_of(before.mode, after.mode);
  if (before.mode.flank != after.mode.flank) {
    if (before.mode.flank == Flank::none) return EventKind::impact;
    return after.mode.flank == Flank::none ? EventKind::opening : EventKind::flank_change;
  }
  if (before.mode.motion != after.mode.motion) return kind_of(before.mode, after.mode);
  if (before.teeth->gear == Motion::stuck) return EventKind::gear_break_away;
  return after.teeth->gear == Motion::stuck ? EventKind::gear_stop : EventKind::gear_reversal;
}

constexpr std::string_view name(EventKind kind) {
  switch (kind) {
    case EventKind::break_away: return "break_away";
    case EventKind::stop: return "stop";
    case EventKind::reversal: return "reversal";
    case EventKind::flank_change: return "flank_change";
    case EventKind::impact: return "impact";
    case EventKind::opening: return "opening";
    case EventKind::gear_break_away: return "gear_break_away";
    case EventKind::gear_stop: return "gear_stop";
    case EventKind::gear_reversal: return "gear_reversal";
  }
  return "";
}

/// A change of mode with both its sides.
struct Event {
  double t;  ///< [s]
  Observation before, after;

  EventKind kind() const { return kind_of(before, after); }
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
      if (changes(rows.back().at, row.at)) trajectory_.events.push_back({row.t, rows.back().at, row.at});
      rows.back() = row;
    } else {
      rows.push_back(row);
    }
  }
  static bool changes(const Observation& before, const Observation& after) {
    return !(before.mode == after.mode) || (before.teeth && before.teeth->gear != after.teeth->gear);
  }

  Trajectory trajectory_;
  bool closed_ = false;
};

}  // namespace wormdrive
