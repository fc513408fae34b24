#include "events/event_log.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace wormdrive {

std::string describe(Mode mode) {
  std::string text;
  switch (mode.motion) {
    case Motion::backward: text = "backward"; break;
    case Motion::stuck: return "stuck";
    case Motion::forward: text = "forward"; break;
  }
  switch (mode.flank) {
    case Flank::right: return text + ", right flank";
    case Flank::none: return text;
    case Flank::left: return text + ", left flank";
  }
  return text;
}

void EventLog::count(double t, std::string_view guard, Mode before, Mode after) {
  ++total_;
  const Entry now{t, guard, before, after};
  if (std::ssize(latest_) < limit_.events) {
    latest_.push_back(now);
    return;
  }
  latest_[oldest_] = now;
  oldest_ = (oldest_ + 1) % latest_.size();
  if (t - entry(0).t < limit_.window) throw chatter();
}

SimulationFailure EventLog::chatter() const {
  const Entry& last = entry(latest_.size() - 1);
  const bool one_guard =
      std::all_of(latest_.begin(), latest_.end(), [&](const Entry& e) { return e.guard == last.guard; });
  const std::string cause =
      one_guard ? "this guard's crossings accumulate: a rest state that the model cannot hold, or a guard that does "
                  "not become positive after its own event"
                : "guards take turns without motion between them: the two modes each lead straight into the other";
  return SimulationFailure(
      fmt::format("chatter: {} events between {:.12g} and {:.12g} s, the last at guard '{}' from {} to {}; {}",
                  latest_.size(), entry(0).t, last.t, last.guard, describe(last.before), describe(last.after), cause));
}

SimulationFailure EventLog::halt(double t, Mode mode, const std::string& reason) const {
  std::string history =
      total_ == 0 ? "before any event" : fmt::format("after {} event{}", total_, total_ == 1 ? "" : "s");
  if (!latest_.empty()) {
    const std::size_t first = latest_.size() - std::min<std::size_t>(3, latest_.size());
    for (std::size_t k = first; k < latest_.size(); ++k)
      history += fmt::format("{} {} at {:.9g} s", k == first ? " (the last:" : ",", entry(k).guard, entry(k).t);
    history += ")";
  }
  return SimulationFailure(fmt::format("cannot go on at t = {:.9g} s, {}, {}: {}", t, describe(mode), history, reason));
}

}  // namespace wormdrive
