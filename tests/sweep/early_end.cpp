// Sweeps that end once a share is known as well as the study asks for: against shares that are known, and as a program.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <numeric>
#include <random>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "sweep/mpirun.hpp"
#include "sweep/stopping_rule.hpp"
#include "sweep/studies.hpp"

namespace wormdrive::test::sweep_early_end {

namespace {

Study study_of(std::vector<double> until, std::uint64_t trials = 1'000'000) {
  Study study;
  study.design = MonteCarlo{trials};
  for (std::size_t k = 0; k < until.size(); ++k) {
    study.metrics.push_back({fmt::format("m{}", k), {}, "", {}});
    study.thresholds.push_back({study.metrics.back().name, 0.0, true, until[k]});
  }
  return study;
}
/// It misses the k-th threshold or keeps it.
Trial trial(std::uint64_t index, std::vector<bool> misses) {
  Trial made;
  made.index = index;
  for (const bool misses_one : misses) made.metrics.push_back(misses_one ? 1.0 : -1.0);
  return made;
}

/// A rule and what it has seen.
struct Watch {
  StoppingRule rule;
  StoppingRule::Counts counts = rule.none();

  void take(const Trial& one) { rule.take(one, counts); }
};

/// Misses of trials that miss with a probability, as far as a rule lets them go.
struct Ended {
  std::uint64_t end, missed;
};
Ended ended(double share, double until, unsigned seed) {
  Watch watch{StoppingRule(study_of({until}))};
  std::mt19937_64 random(seed);
  std::bernoulli_distribution misses(share);
  std::uint64_t index = 0, missed = 0;
  while (!watch.rule.end()) {
    const bool one = misses(random);
    missed += one;
    watch.take(trial(index++, {one}));
  }
  return {index, missed};
}

/// One trial in five misses the limit.
std::string ends_early(int trials, int percent) {
  return edited(study_but("trials = 200", fmt::format("trials = {}", trials)), "-2.5", "-0.303") +
         fmt::format("until_percent = {}\n", percent);
}

}  // namespace

TEST_CASE("a sweep ends when a share is as well known as was asked for, and not much later", "[sweep]") {
  for (const double share : {0.5, 0.1, 0.01})
    for (const double until : {0.1, 0.3}) {
      INFO("share " << share << ", until " << until);
      constexpr int sweeps = 100;
      // a standard deviation of the share is sqrt(share (1 - share) / n); 1.96 of them are what is asked for
      const double enough = std::max(100.0, 1.96 * 1.96 * (1.0 - share) / (share * until * until));
      int held = 0;
      for (unsigned seed = 0; seed < sweeps; ++seed) {
        const Ended e = ended(share, until, seed);
        const double n = static_cast<double>(e.end), found = static_cast<double>(e.missed) / n;
        const double sigma = std::sqrt(found * (1.0 - found) / n);
        CHECK(1.96 * sigma <= until * found * 1.01);
        CHECK(n < 1.1 * enough * (1.0 + 4.0 * until));
        CHECK(n > 0.9 * enough * (1.0 - 3.0 * until));
        held += std::abs(found - share) <= 1.96 * sigma + 0.5 / n;
      }
      CHECK(held >= 88);  // 95 are expected, 2.2 their standard deviation
    }
}

TEST_CASE("the end of a sweep does not depend on the order of its trials", "[sweep]") {
  std::mt19937_64 random(5);
  std::bernoulli_distribution often(0.2), rarely(0.04);
  std::vector<Trial> trials;
  for (std::uint64_t k = 0; k < 5000; ++k) trials.push_back(trial(k, {often(random), rarely(random)}));
  trials[7].status = TrialStatus::refused;  // it counts, and misses nothing
  std::optional<std::uint64_t> in_order;
  for (int shuffled = 0; shuffled < 4; ++shuffled) {
    Watch watch{StoppingRule(study_of({0.2, 0.2}))};
    for (const Trial& one : trials) watch.take(one);
    REQUIRE(watch.rule.end());
    if (shuffled == 0) in_order = watch.rule.end();
    CHECK(watch.rule.end() == in_order);
    CHECK(*watch.rule.end() > 2000);  // the one that is missed less needs more: 96 (1 - p)/p
    std::shuffle(trials.begin(), trials.end(), random);
  }
  Watch never{StoppingRule(study_of({0.01}))};
  for (const Trial& one : trials) never.take(one);
  CHECK_FALSE(never.rule.end());

  // and not on who has made them: three processes that tell each other now and then
  const StoppingRule rule(study_of({0.2, 0.2}));
  std::vector<StoppingRule> rules(3, rule);
  std::vector<StoppingRule::Counts> untold(3, rule.none());
  StoppingRule::Counts all = rule.none();
  for (const Trial& one : trials) {
    const std::size_t who = random() % 3;
    rule.count(one, untold[who]);
    if (random() % 50 != 0) continue;
    add(all, std::exchange(untold[who], rule.none()));
    rules[who].look(all);
  }
  for (std::size_t who = 0; who < 3; ++who) add(all, untold[who]);
  for (StoppingRule& one : rules) {
    one.look(all);
    CHECK(one.end() == in_order);
    CHECK(one.failed() == 1);
  }
}

TEST_CASE("a sweep that ends early has the same trials for any threads, interrupted or not", "[sweep]") {
  const StudyFolder folder(ends_early(100000, 20));
  const Outcome first = folder.sweep({"-o", "a.h5", "--threads", "1", "--referee", "1"});
  INFO(first.out << first.err);
  REQUIRE(first.exit == 0);
  CHECK(first.out.find("at most 100000 trials, seed 3") != std::string::npos);
  const std::size_t trials = folder.present("a.h5");
  CHECK(first.out.find(fmt::format("{} of at most 100000 trials are enough", trials)) != std::string::npos);
  REQUIRE(folder.sweep({"-o", "b.h5", "--threads", "4", "--referee", "0"}).exit == 0);
  CHECK(folder.rows("a.h5") == folder.rows("b.h5"));
  const Outcome again = folder.sweep({"-o", "b.h5", "--resume"});
  CHECK(again.out.find("b.h5 already contains every trial") != std::string::npos);

  // the interval as the summary has it
  const nlohmann::json limit = nlohmann::json::parse(folder.run({"summary", "a.h5", "--json"}).out)["thresholds"][0];
  const double share = limit["share"]["value"], low = limit["share"]["low"], high = limit["share"]["high"];
  CHECK(high - low <= 2 * 0.2 * share);
  CHECK(high - low > 2 * 0.17 * share);

  folder.write("study.toml", ends_early(150, 1));
  const Outcome all = folder.sweep({"-o", "d.h5", "--referee", "0"});
  INFO(all.out << all.err);
  CHECK(all.exit == 0);
  CHECK(all.out.find("all 150 trials are not enough for what until_percent asks") != std::string::npos);
  CHECK(folder.present("d.h5") == 150);
}

TEST_CASE("a sweep that would end early and is killed goes on to the same end", "[sweep][slow]") {
  const StudyFolder folder(ends_early(1000000, 1));
  REQUIRE(folder.sweep({"-o", "a.h5", "--referee", "0"}).exit == 0);
  for (int kills = 0; kills < 2; ++kills) folder.interrupted({"-o", "b.h5", "--resume"}, SIGKILL);
  const Outcome last = folder.sweep({"-o", "b.h5", "--resume", "--referee", "0"});
  INFO(last.out << last.err);
  REQUIRE(last.exit == 0);
  CHECK(folder.rows("a.h5") == folder.rows("b.h5"));
}

TEST_CASE("ranks end where one process does, with its rows, killed and resumed by any number of ranks or not",
          "[sweep][slow]") {
  if (!has_mpi()) return;
  const StudyFolder folder(ends_early(1000000, 3));
  REQUIRE(folder.sweep({"-o", "alone.h5", "--referee", "0"}).exit == 0);
  for (const char* count : {"2", "3"}) {
    const std::string file = std::string(count) + ".h5";
    const Outcome outcome = Process(on_ranks(count, {"-o", file}), folder.path()).wait();
    INFO(outcome.out << outcome.err);
    REQUIRE(outcome.exit == 0);
    CHECK(outcome.out.find(fmt::format("{} of at most 1000000 trials are enough", folder.present("alone.h5"))) !=
          std::string::npos);
    CHECK(folder.rows(file) == folder.rows("alone.h5"));
    CHECK(folder.run({"diff", file, "alone.h5"}).exit == 0);
    const Outcome again = Process(on_ranks(count, {"-o", file, "--resume"}), folder.path()).wait();
    CHECK(again.out.find("already contains every trial") != std::string::npos);
  }
  folder.write("study.toml", ends_early(1000000, 1));
  REQUIRE(folder.sweep({"-o", "longer.h5", "--referee", "0"}).exit == 0);
  int killed = 0;
  for (const char* generation : {"1", "2"}) {
    Process job(on_ranks("3", {"-o", "killed.h5", "--resume"}), folder.path());
    const std::string part = folder / fmt::format("killed.h5.rank_{}_2.part", generation);
    while (!folder.names().contains("killed.h5") && rows_so_far(part, "trials/status") == 0) usleep(1000);
    killed += lose_a_rank();
    job.wait();
  }
  CHECK(killed > 0);
  const Outcome last = Process(on_ranks("2", {"-o", "killed.h5", "--resume"}), folder.path()).wait();
  INFO(last.out << last.err);
  REQUIRE(last.exit == 0);
  CHECK(folder.rows("killed.h5") == folder.rows("longer.h5"));
}

TEST_CASE("what cannot end early is rejected", "[sweep]") {
  const StudyFolder folder(ends_early(100000, 20));
  CHECK(folder.sweep({"--shard", "1/2"}).err ==
        "study.toml: error: threshold.until_percent ends a sweep whose processes count together; remove it, or run "
        "without --shard\n");
  folder.write("study.toml", edited(ends_early(200, 20), "monte_carlo", "sobol"));
  CHECK(folder.sweep({}).err ==
        "study.toml:22:17: error: threshold[0].until_percent is for sweep.design = \"monte_carlo\": the trials of "
        "another design belong together; remove one of the two\n");
  folder.write("study.toml", ends_early(200, 0));
  CHECK(folder.sweep({}).err ==
        "study.toml:22:17: error: threshold[0].until_percent = 0 % must be at least 0.01 % and at most 100 %\n");
}

}  // namespace wormdrive::test::sweep_early_end
