#include <algorithm>

#include <fmt/format.h>

#include "catch.hpp"
#include "cli/program.hpp"
#include "description/diagnostics.hpp"
#include "numbers.hpp"
#include "scenarios/lanes.hpp"
#include "scenarios/random_loops.hpp"
#include "simulation/lanes/lane_run.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/solver_cross_check.hpp"

// Trials in the lanes of registers, of random drives with up to five effects at once, judged by CVODE under the same
// torques: many of these loops are unstable and would amplify the last digit of either solver.

namespace wormdrive::test::scenarios_lanes_by_cvode {

namespace {

using near_ties::Dice;

/// A drive, and how far CVODE may be from it [rad].
struct Drawn {
  std::vector<std::string> words;
  double most;
};

/// What a number of drives have shown.
struct Judged {
  int drives = 0, in_lanes = 0;
  long events = 0;
  Deviation apart;

  /// Judges so many drives of a seed, each drawn by draw(dice, loop), at most one in two of which may jam.
  template <class Draw>
  void judge(int count, std::uint64_t seed, const Draw& draw) {
    for (int index = 0; drives < count; ++index) {
      REQUIRE(index < 2 * count);
      Dice dice(seed, static_cast<std::uint64_t>(index));
      const RandomLoop loop = draw_loop(dice);
      const Drawn drawn = draw(dice, loop);
      judge(loop, drawn.words, static_cast<std::uint64_t>(index), drawn.most);
    }
  }
  /// Runs three trials of a drive, and counts it unless it jams.
  void judge(const RandomLoop& loop, const std::vector<std::string>& words, std::uint64_t index, double most) {
    INFO(fmt::format("drive {}: {}", index, fmt::join(words, " ")));
    std::mt19937_64 random(index);
    std::vector<Scenario> trials;
    for (int k = 0; k < 3; ++k)
      trials.push_back(varied(load_scenario(shipped(law_of(loop)), words, Purpose::run), random, 0.02));
    in_lanes += fits_lane(trials.front());
    const std::vector<BatchResult> rows = run_batch(trials);
    REQUIRE(strangers(trials, rows) == 0);
    const auto* const row = std::get_if<RunSummary>(&rows.front());
    if (!row) return;
    ++drives;
    for (const long count : row->events) events += count;
    const double angle = cross_check(trials.front()).angle;
    apart.add(angle);
    REQUIRE(angle <= most);
  }
};

/// The words of one list behind those of another.
std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}
/// Those words that do not begin so.
std::vector<std::string> without(std::vector<std::string> words, std::initializer_list<const char*> begins) {
  std::erase_if(words, [&](const std::string& word) {
    return std::ranges::any_of(begins, [&](const char* begin) { return word.starts_with(begin); });
  });
  return words;
}

}  // namespace

TEST_CASE("lanes: 200 random drives with up to five effects are what CVODE finds, on any scale of time and size") {
  Judged all;
  all.judge(200, 22, [](Dice& dice, const RandomLoop& loop) {
    const std::vector<std::string> words = nominal_words(dice, loop);
    return Drawn{words + additions(dice, loop, 5), 1e-7};  // a tenth of what a sweep's referee asks
  });
  CAPTURE(all.apart, all.events, all.in_lanes);
  CHECK(all.in_lanes >= 180);
  CHECK(all.events > 4000);
}

TEST_CASE("lanes: 60 random drives with winding, bristles, heat, coupling or stops are what CVODE finds as well") {
  Judged all;
  all.judge(60, 23, [](Dice& dice, const RandomLoop& loop) {
    std::vector<std::string> words = nominal_words(dice, loop) + effects_with_states(dice, loop);
    const double tolerance = dice.decades(1e-12, 1e-9);
    words.push_back(fmt::format("run.relative_tolerance={}", tolerance));
    const auto others = without(additions(dice, loop, 3), {"effect.dc_motor", "effect.static_friction"});
    return Drawn{words + others, std::min(1e-7, 3e3 * tolerance)};
  });
  CAPTURE(all.apart, all.events, all.in_lanes);
  CHECK(all.in_lanes >= 50);
  CHECK(all.events > 1000);
}

TEST_CASE("lanes: 120 random drives whose equations compare, or change at given times, are what CVODE finds as well") {
  Judged all;
  all.judge(120, 25, [](Dice& dice, const RandomLoop& loop) {
    std::vector<std::string> words = nominal_words(dice, loop);
    words = words + what_compares(dice, loop);
    words = words + without(additions(dice, loop, 2), {"load="});
    if (dice.chance(0.2)) words = words + std::vector{effects_with_states(dice, loop).front()};
    return Drawn{words, 1e-7};
  });
  CAPTURE(all.apart, all.events, all.in_lanes);
  CHECK(all.in_lanes == 120);
  CHECK(all.events > 1000);
}

TEST_CASE("lanes: 40 random drives under a load that turns up to twenty times within a sample, as CVODE finds them") {
  Judged all;
  all.judge(40, 27, [](Dice& dice, const RandomLoop& loop) {
    std::vector<std::string> words = nominal_words(dice, loop);
    words = words + without(additions(dice, loop, 2), {"load="});
    words.push_back("run.relative_tolerance=1e-11");
    words.push_back(fmt::format("run.duration_s={}", 0.1 * loop.T));  // CVODE takes its time
    words.push_back(fmt::format("load={{kind=\"sinusoid\",amplitude_Nm={},frequency_Hz={}}}",
                                loop.torque() * dice.decades(1e-4, 0.1), dice.decades(50.0, 2e4) / loop.T));
    return Drawn{words, 1e-7};
  });
  CAPTURE(all.apart, all.events, all.in_lanes);
  CHECK(all.in_lanes >= 32);
  CHECK(all.events > 200);
}

TEST_CASE("a state that moves nothing, and settles within a third of a sample, is as exact as the motion") {
  const auto rise = [](const char* solver) {
    const std::vector<std::string> words{
        fmt::format("run.solver={}", solver), "run.duration_s=0.2035", "metrics.from_s=0",
        "run.relative_tolerance=1e-9",
        "effect.dc_motor={resistance_ohm=0.8,torque_constant_Nm_per_A=0.04,heat_capacity_J_per_K=3e-4,"
        "thermal_resistance_K_per_W=1}"};
    const Scenario scenario = load_scenario(shipped("fig10_sliding_014rad_bare.toml"), words, Purpose::run);
    const RunSummary run = run_scenario(scenario);
    using States = StateLayout<EffectList<double>>;
    return run.end.states[States::first<DcMotor<double>>() + 1];
  };
  const double taylor = rise("taylor"), cvode = rise("cvode");
  REQUIRE(cvode > 0.01);  // [K]
  REQUIRE_THAT(taylor, Catch::Matchers::WithinRel(cvode, 1e-6));
}

}  // namespace wormdrive::test::scenarios_lanes_by_cvode
