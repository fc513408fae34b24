#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "catch.hpp"
#include "description/diagnostics.hpp"
#include "events/simulation_failure.hpp"
#include "near_ties/dice.hpp"
#include "scenarios/random_effects.hpp"
#include "simulation/run_scenario.hpp"

// Drives with several effects of motors, bearings and loads, one number of which is where the list of their events
// changes: something touches something else, whatever it is. Every solver goes on to the end, with one of the lists
// that there are on either side.

namespace wormdrive::test::scenarios_ties_of_effects {

namespace {

constexpr std::array solvers{"run.method=bdf", "run.method=adams", "run.solver=taylor"};

/// The modes before and behind every event.
using Modes = std::vector<std::pair<Mode, Mode>>;

Modes modes_of(const std::vector<Event>& events) {
  Modes list;
  for (const Event& event : events) list.emplace_back(event.before.mode, event.after.mode);
  return list;
}

/// A drive of which one number can be chosen.
struct Tie {
  DrawnDrive drive;
  DrawnNumber number;

  std::vector<Event> events(const char* solver, double value) const {
    const Scenario scenario = scenario_of(
        drive, {solver, fmt::format("run.duration_s={}", 1.2 * drive.period), fmt::format("{}={}", number.key, value)});
    return simulate_scenario(scenario).events;
  }
  Modes modes(const char* solver, double value) const { return modes_of(events(solver, value)); }
};

/// A value of the number at which the list changes within rounding, by Adams.
std::optional<double> edge(const Tie& tie) {
  const char* const by = solvers[1];
  double here = tie.number.value, there = here;
  const Modes on_this_side = tie.modes(by, here);
  bool changes = false;
  for (int k = 1; k < 9 && !changes; ++k) {
    here = std::exchange(there, tie.number.value * (1.0 + 0.02 * k * k));
    changes = tie.modes(by, there) != on_this_side;
  }
  if (!changes) return {};
  while (std::abs(there - here) > 1e-13 * std::abs(here)) {
    const double middle = std::midpoint(here, there);
    (tie.modes(by, middle) == on_this_side ? here : there) = middle;
  }
  return here;
}

/// Without changes that are taken back so soon that the errors of a solver decide whether they are seen: where a share
/// of 1e-8 of something is missing, a touch is over within 3e-4 of its time scale.
Modes lasting(const std::vector<Event>& events, double period) {
  Modes list;
  double last = 0.0;
  for (const Event& event : events) {
    const std::pair change(event.before.mode, event.after.mode);
    if (!list.empty() && event.t - last < 1e-4 * period && list.back().first == change.second)
      list.pop_back();
    else
      list.push_back(change);
    last = event.t;
  }
  return list;
}

/// Whether a list is what a solver tells for a number that differs by no more than the solvers' errors.
bool in_the_neighbourhood(const Tie& tie, const char* solver, double value, const Modes& list) {
  for (double apart = 1e-13; apart < 1e-8; apart *= 3.0)
    for (const double side : {-1.0, 1.0})
      if (tie.modes(solver, value * (1.0 + side * apart)) == list) return true;
  return false;
}

/// What came of some drives.
struct Counts {
  int cases = 0, same = 0, rounding = 0;
  std::string faults;  ///< a line for each
};

Counts judge(const std::vector<std::uint64_t>& trials) {
  Counts counts;
  for (const std::uint64_t trial : trials) {
    near_ties::Dice dice(20261128, trial);
    Tie tie{draw_effects(dice), {}};
    tie.number = tie.drive.numbers[static_cast<std::size_t>(dice.below(static_cast<int>(tie.drive.numbers.size())))];
    const double beyond = 1.0 + (dice.chance(0.1) ? 0.0 : dice.sign() * dice.decades(1e-16, 1e-4));
    double value = 0.0;
    const auto fault = [&](const std::string& why) {
      counts.faults +=
          fmt::format("{}: {} {}={}: {}\n", trial, fmt::join(tie.drive.words, " "), tie.number.key, value, why);
    };
    try {
      const std::optional<double> found = edge(tie);
      if (!found) continue;
      ++counts.cases;
      value = *found * beyond;
      std::array<Modes, solvers.size()> lists, longer;
      for (std::size_t k = 0; k < solvers.size(); ++k) {
        const std::vector<Event> events = tie.events(solvers[k], value);
        lists[k] = modes_of(events);
        longer[k] = lasting(events, tie.drive.period);
      }
      bool same = true, rounding = true;
      for (std::size_t a = 0; a < solvers.size(); ++a)
        for (std::size_t b = 0; b < solvers.size(); ++b) {
          if (lists[a] == lists[b]) continue;
          same = false;
          rounding = rounding && (longer[a] == longer[b] || in_the_neighbourhood(tie, solvers[b], value, lists[a]));
        }
      counts.same += same;
      counts.rounding += !same && rounding;
      if (!rounding) fault("lists of events differ");
    } catch (const SimulationFailure& failure) {
      fault(failure.what());
    } catch (const InputFault&) {  // it would jam
    }
  }
  return counts;
}

}  // namespace

TEST_CASE("drives with several effects at the edge of an event end alike by every solver", "[slow]") {
  const Counts found = judge({3, 4, 7, 8, 9, 11, 16, 17, 21, 27});  // those that take least time
  INFO(found.faults);
  CHECK(found.faults.empty());
  REQUIRE(found.cases >= 9);
}

TEST_CASE("so do several hundred, in half an hour", "[.][long]") {
  std::vector<std::uint64_t> trials(400);
  std::iota(trials.begin(), trials.end(), 100);
  const Counts found = judge(trials);
  INFO(found.faults);
  CHECK(found.faults.empty());
  REQUIRE(found.cases > 150);
  WARN(found.cases << " drives: " << found.same << " alike, " << found.rounding << " differ by the solvers' errors");
}

}  // namespace wormdrive::test::scenarios_ties_of_effects
