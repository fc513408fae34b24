#include "sweep/worst_case.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include <nlopt.h>

#include "scenarios/faults.hpp"
#include "sweep/summary.hpp"

namespace wormdrive {
namespace {

/// One search from one start.
class Search {
 public:
  Search(const Study& study, std::size_t metric, double sign, const WorstCaseSettings& settings)
      : trials_(study), metric_(metric), sign_(sign), settings_(settings) {}

  void from(std::uint64_t trial, std::uint64_t most) {
    std::vector<double> u = trials_.point(trial);
    for (double& x : u) x = std::clamp(x, settings_.tail, 1.0 - settings_.tail);
    const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> optimiser(
        nlopt_create(NLOPT_LN_SBPLX, static_cast<unsigned>(u.size())), nlopt_destroy);
    nlopt_set_lower_bounds1(optimiser.get(), settings_.tail);
    nlopt_set_upper_bounds1(optimiser.get(), 1.0 - settings_.tail);
    nlopt_set_initial_step1(optimiser.get(), 0.2);
    nlopt_set_maxeval(optimiser.get(), static_cast<int>(most));
    nlopt_set_xtol_abs1(optimiser.get(), 1e-6);
    nlopt_set_max_objective(
        optimiser.get(),
        [](unsigned n, const double* x, double*, void* self) {
          return static_cast<Search*>(self)->value({x, x + n});
        },
        this);
    double best = 0.0;
    nlopt_optimize(optimiser.get(), u.data(), &best);  // however it ends: the best one is kept here
  }

  std::vector<double> point;                                ///< the worst
  double worst = -std::numeric_limits<double>::infinity();  ///< times the sign
  std::uint64_t evaluations = 0;

 private:
  static constexpr double no_drive = -1e300;  ///< what cannot run is not worse than what can

  double value(const std::vector<double>& u) {
    const Trial trial = trials_.at(u);
    ++evaluations;
    const double value = sign_ * trial.metrics[metric_];
    if (!std::isfinite(value)) return no_drive;
    if (value > worst) {
      worst = value;
      point = u;
    }
    return value;
  }

  Trials trials_;
  std::size_t metric_;
  double sign_;
  const WorstCaseSettings& settings_;
};

}  // namespace

WorstCase find_worst(const SweepReader& sweep, const WorstCaseSettings& settings) {
  constexpr unsigned starts = 4;
  const SweepSummary summary = summarise(sweep, settings.metric, starts);
  const Study& study = sweep.study();
  if (summary.worst.empty()) refuse({sweep.path()}, "has no trial from which a search could start: none is done");
  const auto metric =
      static_cast<std::size_t>(std::find_if(study.metrics.begin(), study.metrics.end(),
                                            [&](const Metric& m) { return m.name == summary.ranked_by; }) -
                               study.metrics.begin());
  const double sign = worse(study, summary.ranked_by);

  std::vector<std::unique_ptr<Search>> searches;
  for (std::size_t k = 0; k < summary.worst.size(); ++k)
    searches.push_back(std::make_unique<Search>(study, metric, sign, settings));
  std::atomic<std::size_t> next{0};
  std::exception_ptr fault;
  std::mutex mutex;
  {
    std::vector<std::jthread> workers;
    for (unsigned t = 0; t < std::min<std::size_t>(settings.threads, searches.size()); ++t)
      workers.emplace_back([&] {
        try {
          for (std::size_t k = next++; k < searches.size(); k = next++)
            searches[k]->from(summary.worst[k].index,
                              std::max<std::uint64_t>(1, settings.evaluations / searches.size()));
        } catch (...) {
          const std::lock_guard lock(mutex);
          fault = std::current_exception();
        }
      });
  }
  if (fault) std::rethrow_exception(fault);

  const auto& best = **std::max_element(searches.begin(), searches.end(),
                                        [](const auto& a, const auto& b) { return a->worst < b->worst; });
  WorstCase worst{summary.ranked_by,
                  study.metrics[metric].unit,
                  sign * best.worst,
                  summary.worst.front().metrics[metric],
                  summary.worst.front().index,
                  0,
                  best.point,
                  {}};
  for (const auto& search : searches) worst.evaluations += search->evaluations;
  worst.found = Trials(study).at(best.point);
  return worst;
}

}  // namespace wormdrive
