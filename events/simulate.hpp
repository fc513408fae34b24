#pragma once
#include <cmath>
#include <concepts>
#include <limits>
#include <utility>

#include "events/event_log.hpp"
#include "events/rest.hpp"
#include "events/timetable.hpp"

namespace wormdrive {

/// Open loop: nobody samples.
struct NoController {
  template <class System>
  double sample(const System&, const typename System::Instant&) {
    return 0.0;
  }
};

/// Why a run stopped, and what the loop alone knows of it.
struct Cause {
  Reason reason;
  int guard = no_guard;  ///< the one that fired
  double torque = 0.0;   ///< held from a sample on [N m], once the controller has answered
};

/// Stays at rest. When a guard releases the system is found once for all reports on the way, so that they decide
/// nothing.
template <class System>
class Rest {
 public:
  /// Forgets what was found, for another rest or other inputs.
  void restart() { known_ = false; }
  /// Stays until next (<= limit, past which nothing is evaluated) or until a guard releases the system, which is
  /// returned, else no_guard.
  int advance(const System& system, typename System::Instant& now, double next, double limit) {
    if (!known_) look_ahead(system, now, next, limit);
    const bool falls = released_.t <= next;
    now.t = falls ? released_.t : next;
    return falls ? released_.guard : no_guard;
  }

 private:
  void look_ahead(const System& system, const typename System::Instant& now, double next, double limit) {
    const auto until = [&](double end) {
      return RestWatch<System>(system, now).first_crossing(end).value_or(Crossing{never, no_guard});
    };
    try {
      released_ = until(limit);
      known_ = true;
    } catch (const SolverFault&) {  // fails no sooner than it has to
      if (next == limit) throw;
      released_ = until(next);
      known_ = released_.guard != no_guard;
    }
  }
  static constexpr double never = std::numeric_limits<double>::infinity();

  bool known_ = false;
  Crossing released_{never, no_guard};  ///< where it is known
};

/// The mode after the inputs have changed; a solver may find it from what it needs anyway.
template <class System, class Solver>
typename System::Mode settle(const System& system, Solver& solver, const typename System::Instant& now) {
  if constexpr (requires { solver.settle(now); })
    return solver.settle(now);
  else
    return system.settle(now);
}

/// The state after a guard has fired; likewise.
template <class System, class Solver>
typename System::Instant jump(const System& system, Solver& solver, const typename System::Instant& now, int guard) {
  if constexpr (requires { solver.jump(now, guard); })
    return solver.jump(now, guard);
  else
    return system.jump(now, guard);
}

/// How far a run has come: where it is, what it does there next, and what lies ahead.
template <class System>
struct Progress {
  Timetable timetable;
  typename System::Instant now;
  EventLog log;
  Cause cause{timetable.pop()};
};

/// Runs a hybrid system on, to the end of its timetable: then it returns true. A controller that has a pause() is asked
/// before every sample; when it tells to, the run is left there, false returned, and may be taken up again.
///
/// controller: sample(system, now) returns the motor torque [N m] held from a sample of the timetable to the next;
/// latch(system, now), if it has one, comes before it where samples see an older angle.
/// solver: restart(now) takes up a state; advance(now, next, limit) integrates to next without looking past limit and
/// returns the guard at which it stopped, or no_guard. record(system, now) sees every report and both sides of every
/// event, in order; where it takes a Cause as well, it is told why. Throws SimulationFailure when the run cannot go on.
template <class System, class Solver, class Controller, class Recorder>
[[gnu::always_inline]] inline bool go_on(System& system, Solver& solver, Controller& controller,
                                         Progress<System>& progress, Recorder&& record) {
  Timetable& timetable = progress.timetable;
  typename System::Instant& now = progress.now;
  EventLog& log = progress.log;
  Cause& cause = progress.cause;
  Rest<System> rest;
  const auto tell = [&] {
    if constexpr (std::invocable<Recorder&, const System&, const typename System::Instant&, const Cause&>)
      record(system, now, cause);
    else
      record(system, now);
  };
  for (;;) {
    switch (cause.reason) {
      case Reason::knot:
        system.enter(now.t);
        timetable.schedule_knot(system.next_knot(now.t));
        now.mode = system.settle(now);
        break;
      case Reason::latch:
        if constexpr (requires { controller.latch(system, now); }) controller.latch(system, now);
        break;
      case Reason::sample: {
        if constexpr (requires { controller.pause(); })
          if (controller.pause()) return false;
        const double tau_m = controller.sample(system, now);
        if (!std::isfinite(tau_m))
          throw log.halt(now.t, now.mode, "the controller returned a torque that is no number");
        cause.torque = tau_m;
        if (system.command(now.t, tau_m)) timetable.schedule_knot(system.next_knot(now.t));
        now.mode = settle(system, solver, now);
        break;
      }
      case Reason::guard: {
        const auto before = now.mode;
        if (cause.guard >= System::guard_count) {  // a bend of the equations changes no mode
          log.count(now.t, "bend of the equations", before, before);
          break;
        }
        now = jump(system, solver, now, cause.guard);
        log.count(now.t, System::guard_name(before, cause.guard), before, now.mode);
        break;
      }
      case Reason::report: break;
      case Reason::end: return true;
    }
    if (cause.reason != Reason::report && cause.reason != Reason::latch) {
      tell();
      System::at_rest(now.mode) ? rest.restart() : solver.restart(now);
    }
    const double next = timetable.next_time();
    int guard = no_guard;
    try {
      const double limit = timetable.next_stop();
      guard = System::at_rest(now.mode) ? rest.advance(system, now, next, limit) : solver.advance(now, next, limit);
    } catch (const SolverFault& fault) {
      throw log.halt(now.t, now.mode, fault.what());
    }
    cause = {guard != no_guard ? Reason::guard : timetable.pop(), guard};
    if (cause.reason != Reason::latch) tell();
  }
}

/// Runs a hybrid system to the end of its timetable and returns its last instant; what takes part in it see go_on().
template <class System, class Solver, class Controller, class Recorder>
typename System::Instant simulate(System& system, Solver& solver, Controller& controller, Timetable timetable,
                                  typename System::Instant now, Recorder&& record, ChatterLimit chatter = {}) {
  Progress<System> progress{timetable, now, EventLog(chatter)};
  go_on(system, solver, controller, progress, record);
  return progress.now;
}

template <class System, class Solver, class Recorder>
typename System::Instant simulate(System& system, Solver& solver, Timetable timetable, typename System::Instant now,
                                  Recorder&& record, ChatterLimit chatter = {}) {
  NoController nobody;
  return simulate(system, solver, nobody, timetable, now, std::forward<Recorder>(record), chatter);
}

}  // namespace wormdrive
