#include "sweep/worst_case.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include <fmt/format.h>
#include <nlopt.h>

#include "description/diagnostics.hpp"
#include "sweep/study/reject_without_distributions.hpp"
#include "sweep/summary/summary.hpp"

namespace wormdrive {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// One search, from one trial or of the whole box.
class Search {
 public:
  Search(const Study& study, const std::string& metric, const WorstCaseSettings& settings)
      : trials_(study), ranking_(ranking_of(study, metric)), settings_(settings), metric_(study.place_of(metric)) {}

  /// Climbs from a trial.
  void from(std::uint64_t trial, std::uint64_t runs) {
    start = trial;
    std::vector<double> u = trials_.point(trial);
    for (double& x : u) x = std::clamp(x, settings_.tail, 1.0 - settings_.tail);
    search(NLOPT_LN_SBPLX, u, runs);
  }
  /// Draws from the whole box, with the noise of a trial, and climbs from the worst that this has found.
  void everywhere(std::uint64_t trial, std::uint64_t seed, std::uint64_t runs) {
    start = trial;
    nlopt_srand(static_cast<unsigned long>(seed));
    search(NLOPT_GN_CRS2_LM, std::vector<double>(trials_.point(trial).size(), 0.5), (2 * runs + 2) / 3);
    if (std::abs(worst) < infinite && runs > evaluations) search(NLOPT_LN_SBPLX, point, runs - evaluations);
  }
  /// How bad a trial is, infinite where nothing is worse; one that is left out is better than all others.
  double badness(const Trial& trial) const {
    const bool done = trial.status == TrialStatus::done;
    if (!done && settings_.done_only) return -infinite;
    return ranking_.sign * ranking_(trial.metrics[metric_], done);
  }

  std::vector<double> point;                 ///< the worst
  double worst = -infinite;                  ///< how bad it is
  std::uint64_t start = 0, evaluations = 0;  ///< the trial whose noise it has

 private:
  static constexpr double beyond_all = 1e300;  ///< a finite stand-in, for the search

  /// However it ends, the worst one is kept here.
  void search(nlopt_algorithm algorithm, std::vector<double> u, std::uint64_t runs) {
    optimiser_.reset(nlopt_create(algorithm, static_cast<unsigned>(u.size())));
    nlopt_set_lower_bounds1(optimiser_.get(), settings_.tail);
    nlopt_set_upper_bounds1(optimiser_.get(), 1.0 - settings_.tail);
    nlopt_set_initial_step1(optimiser_.get(), 0.2);
    nlopt_set_maxeval(optimiser_.get(), static_cast<int>(runs));
    nlopt_set_xtol_abs1(optimiser_.get(), 1e-6);
    nlopt_set_max_objective(
        optimiser_.get(),
        [](unsigned n, const double* x, double*, void* self) {
          return static_cast<Search*>(self)->tried({x, x + n});
        },
        this);
    double best = 0.0;
    nlopt_optimize(optimiser_.get(), u.data(), &best);
  }

  double tried(const std::vector<double>& u) {
    const double bad = badness(trials_.at(u, start));
    ++evaluations;
    if (bad > worst) {
      worst = bad;
      point = u;
    }
    if (worst == infinite) nlopt_force_stop(optimiser_.get());
    return std::clamp(bad, -beyond_all, beyond_all);
  }

  Trials trials_;
  Ranking ranking_;
  const WorstCaseSettings& settings_;
  std::size_t metric_;
  std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> optimiser_{nullptr, nlopt_destroy};
};

}  // namespace

WorstCase find_worst(const SweepReader& sweep, const WorstCaseSettings& settings) {
  constexpr unsigned starts = 4;
  const SweepSummary summary =
      summarise(sweep, {.ranked_by = settings.metric, .worst = starts, .done_only = settings.done_only});
  const Study& study = sweep.study();
  reject_without_distributions(study, sweep.path(), "sweep a study with distributions");
  if (summary.worst.empty())
    reject({sweep.path()},
           fmt::format("has no trial to start a search from{}", settings.done_only ? ": none ran to the end" : ""));

  std::vector<std::unique_ptr<Search>> searches;
  for (std::size_t k = 0; k <= summary.worst.size(); ++k)
    searches.push_back(std::make_unique<Search>(study, summary.ranked_by, settings));
  Trials trials(study);
  const Trial& before = summary.worst.front();
  if (searches.front()->badness(before) == infinite)
    return {summary.ranked_by, before, 0, before, trials.scenario(before.index)};
  // two fifths of the runs for the starts, but one for each, the others for the whole box
  const std::uint64_t for_each_start = std::max<std::uint64_t>(1, settings.evaluations * 2 / 5 / summary.worst.size()),
                      for_box = settings.evaluations - for_each_start * summary.worst.size();
  std::atomic<std::size_t> next{0};
  std::exception_ptr fault;
  std::mutex mutex;
  {
    std::vector<std::jthread> workers;
    for (unsigned t = 0; t < std::min<std::size_t>(settings.threads, searches.size()); ++t)
      workers.emplace_back([&] {
        try {
          for (std::size_t k = next++; k < searches.size(); k = next++)  // the longest first
            if (k > 0)
              searches[k]->from(summary.worst[k - 1].index, for_each_start);
            else if (for_box > 0)
              searches[k]->everywhere(before.index, study.seed, for_box);
        } catch (...) {
          const std::lock_guard lock(mutex);
          fault = std::current_exception();
        }
      });
  }
  if (fault) std::rethrow_exception(fault);

  const Search& best = **std::max_element(searches.begin(), searches.end(),
                                          [](const auto& a, const auto& b) { return a->worst < b->worst; });
  WorstCase worst{summary.ranked_by, before, 0, before, {}};
  for (const auto& search : searches) worst.evaluations += search->evaluations;
  if (best.worst > -infinite) {
    worst.found = trials.at(best.point, best.start);
    worst.scenario = trials.scenario();
  } else {  // no drive within the box has come to anything
    worst.scenario = trials.scenario(before.index);
  }
  return worst;
}

}  // namespace wormdrive
