#include <algorithm>
#include <exception>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "catch.hpp"
#include "cli/program.hpp"
#include "near_ties/dice.hpp"
#include "numbers.hpp"
#include "scenarios/random_effects.hpp"
#include "simulation/run_scenario.hpp"
#include "support.hpp"

// Several effects of motors, bearings and loads at once: every solver finds the same events, and the audit confirms
// them.

namespace wormdrive::test::scenarios_many_effects {

namespace {

/// How many drives were compared, and how many events they had.
struct Compared {
  long drives = 0, events = 0;
};

Compared compare(std::uint64_t trials) {
  Compared all;
  for (std::uint64_t trial = 0; trial < trials; ++trial) {
    near_ties::Dice dice(20261207, trial);
    const DrawnDrive drive = draw_effects(dice);
    INFO(trial << ": " << fmt::format("{}", fmt::join(drive.words, " ")));
    const auto scenario = unless_it_jams(drive, {"run.method=bdf"});
    if (!scenario) continue;
    const Trajectory told = simulate_scenario(*scenario);
    const AuditReport report = *run_scenario(*scenario, {.audit = true}).audit;
    CHECK(report.findings.empty());
    for (const char* by : {"run.method=adams", "run.solver=taylor"}) {
      INFO(by);
      const Trajectory other = simulate_scenario(scenario_of(drive, {by}));
      CHECK(other.events.size() == told.events.size());
      Deviation late;
      for (std::size_t k = 0; k < std::min(told.events.size(), other.events.size()); ++k) {
        CHECK(other.events[k].after.mode == told.events[k].after.mode);
        late.add((other.events[k].t - told.events[k].t) / scenario->run.duration);
      }
      CHECK(late <= 1e-7);
    }
    ++all.drives;
    all.events += static_cast<long>(told.events.size());
  }
  return all;
}

}  // namespace

TEST_CASE("drives with one to six effects of motors, bearings and loads have the same events by every solver") {
  const Compared all = compare(6);
  REQUIRE(all.drives >= 5);
  REQUIRE(all.events > 40);
}

TEST_CASE("so have several hundred, in a quarter of an hour", "[.][long]") {
  const Compared all = compare(300);
  REQUIRE(all.drives > 200);
  WARN(all.drives << " drives, " << all.events << " events");
}

}  // namespace wormdrive::test::scenarios_many_effects
