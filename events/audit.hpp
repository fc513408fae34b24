#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/elastic/compliant_energy.hpp"
#include "core/energy.hpp"
#include "core/numbers/crossing.hpp"
#include "core/numbers/rounded.hpp"
#include "core/ripple.hpp"
#include "events/fine_steps.hpp"
#include "events/segment_start.hpp"

namespace wormdrive {

/// Something that the audit found and the run did not, or the other way round.
struct AuditFinding {
  double t;  ///< [s]
  Mode mode;
  std::string guard;
  bool missed;  ///< true: a crossing without an event; false: an event without a crossing
};

/// The smallest positive minimum of a kind of guard: how near the run came to one more event.
struct Graze {
  double distance = std::numeric_limits<double>::infinity();
  double t = 0.0;  ///< [s]
};

struct AuditReport {
  long guards = 0;  ///< guards scanned, one for every guard of every segment
  long events = 0;  ///< guard events that the scan confirmed
  std::vector<AuditFinding> findings;
  std::map<std::string, Graze, std::less<>> closest;  ///< by the guard's name, in its own units
  double largest_time_error = 0.0;                    ///< of a confirmed event [s]
  double largest_angle_error = 0.0;  ///< at the end of a segment, of elastic teeth also of the worm [rad]
  double largest_speed_error = 0.0;  ///< likewise [rad/s]
  double work = 0.0;                 ///< absolute work of motor and load [J]
  double energy_error = 0.0;         ///< motor + load - loss - change of the stored energy [J]

  long missed() const {
    return std::count_if(findings.begin(), findings.end(), [](const AuditFinding& f) { return f.missed; });
  }
};

/// Records what an audit needs: every instant of a run and how many steps the solver had taken by then.
template <class System, class Solver>
struct AuditTrail {
  struct Entry {
    typename System::Instant now;
    long steps;
  };
  const Solver& solver;
  std::vector<Entry> entries{};

  void operator()(const System&, const typename System::Instant& now) {
    entries.push_back({now, solver.statistics().steps});
  }
};

/// The cubic through the values and rates of a guard at both ends of a step.
struct Cubic {
  double c0, c1, c2, c3;

  template <class Guard>
  Cubic(const Guard& left, const Guard& right, double h) : c0(left[0]), c1(left[1]) {
    const double slope = (right[0] - left[0]) / h;
    c2 = (3.0 * slope - 2.0 * left[1] - right[1]) / h;
    c3 = (left[1] + right[1] - 2.0 * slope) / (h * h);
  }
  double operator()(double s) const { return c0 + s * (c1 + s * (c2 + s * c3)); }
  /// Where it is lowest in [0, h], for a cubic that falls at 0 and rises at h.
  double lowest(double h) const {
    return std::clamp(-c1 / (c2 + std::sqrt(std::max(0.0, c2 * c2 - 3.0 * c3 * c1))), 0.0, h);
  }
  /// Where it falls through zero in (0, h], for a cubic that is positive at 0 and not at h.
  double root(double h) const {
    const double end = (*this)(h);
    return end >= 0.0 ? h : root_between(FunctionView<double>(*this), 0.0, c0, h, end);  // zero to rounding counts as h
  }
};

/// Re-integrates every segment of a run from its stored start with the classical Runge-Kutta method of order 4 at a
/// twentieth of the solver's mean step, or implicitly where that is stiff, and follows every guard and its rate from
/// step to step.
template <class System>
class Audit {
 public:
  using Instant = typename System::Instant;

  /// The system's inputs are moved to each segment in turn.
  explicit Audit(System& system) : system_(system), steps_(system) {}

  template <class Trail>
  AuditReport examine(const Trail& trail) {
    const auto& entries = trail.entries;
    for (std::size_t first = 0; first < entries.size();) {
      std::size_t last = first;
      while (last + 1 < entries.size() && entries[last + 1].now.t > entries[last].now.t &&
             entries[last + 1].now.mode == entries[first].now.mode)
        ++last;
      const bool mode_ended = last + 1 < entries.size() && !(entries[last + 1].now.mode == entries[last].now.mode);
      segment(entries[first].now, entries[last].now, entries[last].steps - entries[first].steps, mode_ended);
      first = last + 1;
    }
    return report_;
  }

 private:
  using Guards = decltype(std::declval<const System&>().guards_ahead(std::declval<const Instant&>()));
  static constexpr int finer = FineSteps<System>::finer;
  static constexpr long least_steps = 10;

  void segment(const Instant& start, const Instant& end, long solver_steps, bool mode_ended) {
    const double span = end.t - start.t;
    system_.enter(start.t);
    mode_ = start.mode;
    const bool input_ended = system_.next_knot(start.t) <= end.t;
    report_.guards += System::guard_count;
    if (span <= 0.0) {
      // A crossing at the very start, from rest on the boundary: both sides are the same instant.
      if (mode_ended && !input_ended) ++report_.events;
      return;
    }
    long steps = finer * std::max(least_steps, solver_steps);
    // the scale of an input or of what swings with an angle, which the solver may have passed over; as fine as where
    // the drive rests and nothing else tells what happens in between
    const double phase = phase_between_looks(System::at_rest(start.mode));
    const double swing =
        std::max({fastest_change(system_, start), ripple_rate(system_, start.x), ripple_rate(system_, end.x)});
    steps = std::max(steps, std::lround(finer * swing * span / phase));
    const double h = span / static_cast<double>(steps);

    Instant now = start;
    const auto floor = guard_starts(system_, now, system_.guards_ahead(now)).floor;
    const auto guards_at = [&](const Instant& at) {
      Guards guards = system_.guards_ahead(at);
      for (int g = 0; g < System::guard_count; ++g) guards[g][0] += floor[g];
      return guards;
    };
    Guards here = guards_at(now);
    std::array<Watched, System::guard_count> watched{};
    const double stored_at_start = stored_energy(system_, start);
    Power work{0.0, 0.0, 0.0};
    for (long k = 1; k <= steps; ++k) {
      const Instant before = now;
      const Guards there = here;
      steps_.advance(now, k == steps ? end.t - now.t : h, work);
      now.t = k == steps ? end.t : start.t + static_cast<double>(k) * h;
      here = guards_at(now);
      for (int g = 0; g < System::guard_count; ++g) {
        Watched& guard = watched[g];
        guard.armed = guard.armed || there[g][0] > 0.0;
        guard.held = guard.held || guard.armed;
        if (!guard.armed) continue;
        const double when = crossing(g, before.t, there[g], now.t, here[g]);
        if (when > now.t) continue;
        guard.falls.push_back(when);
        guard.armed = here[g][0] > 0.0;
      }
    }
    judge(start, end, here, watched, mode_ended && !input_ended, span / static_cast<double>(std::max(1L, solver_steps)),
          std::max(h, 4.0 * time_resolution(end.t)));
    for (int k = 0; k < 2 * shaft_count<System>(); k += 2) {
      report_.largest_angle_error = std::max(report_.largest_angle_error, distance(now.x[k], end.x[k]));
      report_.largest_speed_error = std::max(report_.largest_speed_error, distance(now.x[k + 1], end.x[k + 1]));
    }
    report_.work += std::abs(work.motor) + std::abs(work.load);
    report_.energy_error += work.motor + work.load - work.loss - (stored_energy(system_, now) - stored_at_start);
  }

  /// Infinite where the audit's own integration came to no number: nothing is confirmed then.
  static double distance(double a, double b) {
    return std::isfinite(a) ? std::abs(a - b) : std::numeric_limits<double>::infinity();
  }

  /// Time at which a guard falls to zero in a step, infinity if it stays positive; notes how near it came.
  template <class Guard>
  double crossing(int g, double t0, const Guard& left, double t1, const Guard& right) {
    constexpr double never = std::numeric_limits<double>::infinity();
    const Cubic cubic(left, right, t1 - t0);
    if (right[0] <= 0.0) return left[0] <= 0.0 ? t0 : t0 + cubic.root(t1 - t0);
    if (!(left[1] < 0.0 && right[1] >= 0.0)) return never;
    const double s = cubic.lowest(t1 - t0), lowest = cubic(s);
    if (lowest <= 0.0) return left[0] <= 0.0 ? t0 : t0 + cubic.root(s);
    if (System::at_rest(mode_)) return never;
    Graze& closest = report_.closest[std::string(System::guard_name(mode_, g))];
    if (lowest < closest.distance) closest = {lowest, t0 + s};
    return never;
  }

  /// A guard over one segment: whether it has ever been positive, and every time that it fell through zero [s].
  struct Watched {
    bool armed = false, held = false;
    std::vector<double> falls{};
  };

  /// Compares the falls of a segment's guards with the event that ended it, if one did. negligible [s]: a fall this
  /// close to the end belongs to its event.
  void judge(const Instant& start, const Instant& end, const Guards& at_end,
             const std::array<Watched, System::guard_count>& watched, bool guard_ended, double solver_step,
             double negligible) {
    const auto until = [&](int g) { return std::abs(at_end[g][0]) / std::max(std::abs(at_end[g][1]), 1e-300); };
    int fired = -1;
    if (guard_ended) {
      fired = 0;  // one that has been positive, if there is any: others stay at zero without firing
      for (int g = 1; g < System::guard_count; ++g)
        if (std::pair(!watched[g].held, until(g)) < std::pair(!watched[fired].held, until(fired))) fired = g;
    }
    for (int g = 0; g < System::guard_count; ++g) {
      std::vector<double> falls = watched[g].falls;
      const auto finding = [&](double t, bool missed) {
        report_.findings.push_back({t, end.mode, std::string(System::guard_name(end.mode, g)), missed});
      };
      if (g == fired) {
        const double error = falls.empty() ? until(g) : end.t - falls.back();
        if (error <= solver_step) {
          ++report_.events;
          report_.largest_time_error = std::max(report_.largest_time_error, error);
          if (!falls.empty()) falls.pop_back();
        } else {
          finding(end.t, false);
        }
      }
      if (!watched[g].held && at_end[g][0] < 0.0) finding(start.t, true);
      for (const double t : falls)
        if (end.t - t > negligible) finding(t, true);
    }
  }

  System& system_;
  FineSteps<System> steps_;
  AuditReport report_;
  typename System::Mode mode_{};
};

}  // namespace wormdrive
