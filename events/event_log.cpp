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

void EventLog::count(double t, const std::string& guard, Mode before, Mode after) {
  ++total_;
  latest_.push_back({t, guard, before, after});
  if (static_cast<int>(latest_.size()) <= limit_.events) return;
  latest_.pop_front();
  if (latest_.back().t - latest_.front().t < limit_.window) throw chatter();
}

SimulationFailure EventLog::chatter() const {
  const Entry& last = latest_.back();
  const bool one_guard =
      std::all_of(latest_.begin(), latest_.end(), [&](const Entry& e) { return e.guard == last.guard; });
  const std::string cause =
      one_guard ? "this guard's crossings accumulate: a rest state that the model cannot hold, or a guard that does "
                  "not become positive after its own event"
                : "guards take turns without motion between them: the two modes each lead straight into the other";
  return SimulationFailure(fmt::format(
      "chatter: {} events between {:.12g} and {:.12g} s, the last at guard '{}' from {} to {}; {}", latest_.size(),
      latest_.front().t, last.t, last.guard, describe(last.before), describe(last.after), cause));
}

SimulationFailure EventLog::halt(double t, Mode mode, const std::string& reason) const {
  std::string history =
      total_ == 0 ? "before any event" : fmt::format("after {} event{}", total_, total_ == 1 ? "" : "s");
  if (!latest_.empty()) {
    const auto first = latest_.end() - std::min<std::ptrdiff_t>(3, std::ssize(latest_));
    for (auto e = first; e != latest_.end(); ++e)
      history += fmt::format("{} {} at {:.9g} s", e == first ? " (the last:" : ",", e->guard, e->t);
    history += ")";
  }
  return SimulationFailure(fmt::format("cannot go on at t = {:.9g} s, {}, {}: {}", t, describe(mode), history, reason));
}

}  // namespace wormdrive
