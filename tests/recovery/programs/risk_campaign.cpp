// Records benches, diagnoses them, and asks what the drives that the data leave possible do in another task: how often
// do they hold the true drive? `risk_campaign --help`.
#include <iostream>
#include <map>
#include <mutex>
#include <string>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "diagnosis/diagnose.hpp"
#include "recovery/forecast.hpp"
#include "statistics/parallel.hpp"
#include "sweep/summary/statistics.hpp"

int main(int argc, char** argv) {
  CLI::App app{
      "Counts how often 95 % of the drives that a diagnosis leaves possible hold the true one in another task."};
  std::string hidden = "nothing", conditions = "realistic";
  recovery::Plan plan;
  std::uint64_t trials = 200;
  int threads = 2, draws = 0;
  app.add_option("--hide", hidden, "what is hidden: single or nothing");
  app.add_option("--conditions", conditions, "ideal, coloured, realistic or double");
  app.add_option("--cases", plan.cases, "number of recordings");
  app.add_option("--seed", plan.seed, "seed of all random numbers");
  app.add_option("--duration", plan.duration, "of a recording [s]");
  app.add_option("--trials", trials, "possible drives of each");
  app.add_option("--draws", draws, "also by so many fits of resampled data; 0: by the normal distribution alone");
  app.add_option("--threads", threads, "recordings at a time");
  CLI11_PARSE(app, argc, argv);
  try {
    plan.kind = recovery::kind(hidden);
    plan.conditions = recovery::conditions(conditions);
    plan.effects = recovery::told_effects();
    struct Count {
      std::uint64_t held = 0, of = 0;
    };
    std::map<std::string, Count> counts;
    std::uint64_t without = 0;
    const auto cases = recovery::draw(plan);
    std::mutex one_at_a_time;
    wormdrive::parallel_for(cases.size(), threads, [&](std::size_t k) {
      const recovery::Bench bench = recovery::record(cases[k]);
      wormdrive::Diagnosis found =
          wormdrive::diagnose(recovery::data_sheet(cases[k]), {bench.recording}, {.draws = draws, .threads = 1});
      std::vector<recovery::Forecast> list;
      if (draws > 0) {
        list = recovery::forecast(cases[k], bench.drive, found, trials);
        for (recovery::Forecast& f : list) f.metric += " (resampled)";
        found.uncertainty.draws.clear();
      }
      for (recovery::Forecast& f : recovery::forecast(cases[k], bench.drive, found, trials))
        list.push_back(std::move(f));
      const std::lock_guard lock(one_at_a_time);
      without += list.empty();
      std::string hiding;
      for (const recovery::Hiding& h : cases[k].hidden) hiding += fmt::format(" {} {:g}", h.secret->effect, h.amount);
      std::cout << fmt::format("{}{}: {}\n", k, hiding, found.sentence);
      for (const recovery::Forecast& f : list) {
        counts[f.metric].held += f.holds();
        ++counts[f.metric].of;
        std::cout << fmt::format("  {} {:.5g} in [{:.5g}, {:.5g}]{}\n", f.metric, f.truth, f.low, f.high,
                                 f.holds() ? "" : " MISSED");
      }
      std::cout << std::flush;
    });
    for (const auto& [metric, count] : counts) {
      const auto share = wormdrive::probability(count.held, count.of);
      std::cout << fmt::format("{}: {} of {} bands hold the true drive, {:.1f} % [{:.1f}, {:.1f}]\n", metric,
                               count.held, count.of, 100 * share.value, 100 * share.low, 100 * share.high);
    }
    if (without > 0) std::cout << fmt::format("{} diagnoses fitted no number\n", without);
  } catch (const std::exception& fault) {
    std::cerr << "risk_campaign: " << fault.what() << "\n";
    return 2;
  }
}
