#include "sweep/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "scenarios/faults.hpp"
#include "scenarios/keys.hpp"

namespace wormdrive {
namespace {

/// Reads one column at a time: memory grows with the trials, but not with columns times trials.
class Summariser {
 public:
  Summariser(const SweepReader& sweep, const std::string& ranked_by) : sweep_(sweep), study_(sweep.study()) {
    std::vector<std::string> names;
    for (const Metric& metric : study_.metrics) names.push_back(metric.name);
    ranked_by_ = ranked_by.empty() ? default_ranking(study_) : ranked_by;
    if (std::find(names.begin(), names.end(), ranked_by_) == names.end())
      refuse({sweep.path()}, "has no metric '" + ranked_by_ + "'; " + suggestion(ranked_by_, names));
    status_ = sweep.column("status");
    if (const auto* const saltelli = std::get_if<Saltelli>(&study_.design); saltelli)
      stride_ = study_.parameters.size() + 2;
  }

  SweepSummary operator()(unsigned worst) {
    SweepSummary summary;
    summary.trials = sweep_.trials();
    const auto with = [&](TrialStatus status) {
      return static_cast<std::uint64_t>(std::count(status_.begin(), status_.end(), static_cast<double>(status)));
    };
    summary.done = with(TrialStatus::done);
    summary.refused = with(TrialStatus::refused);
    summary.halted = with(TrialStatus::halted);
    summary.sample = is_sample(study_.design);
    summary.ranked_by = ranked_by_;
    for (const Metric& metric : study_.metrics) {
      const std::vector<double> values = of_done_trials(metric.name);
      summary.metrics.push_back(distribution(metric, values));
      for (const Threshold& threshold : study_.thresholds)
        if (threshold.metric == metric.name) summary.thresholds.push_back(missed(threshold, metric.unit, values));
      if (metric.name.starts_with("condition_")) note_condition(metric, values, summary);
      if (metric.name == ranked_by_) rank(values, worst, summary);
    }
    return summary;
  }

 private:
  /// Whether a trial stands for the distribution of the parameters: in a Saltelli design A and B alone do.
  bool counts(std::size_t row) const { return (sweep_.range().first + row) % stride_ < 2 || stride_ == 1; }
  bool done(std::size_t row) const { return status_[row] == static_cast<double>(TrialStatus::done); }

  /// A column; not a number where a trial is missing or not done.
  std::vector<double> of_done_trials(const std::string& name) const {
    std::vector<double> values = sweep_.column(name);
    for (std::size_t row = 0; row < values.size(); ++row)
      if (!done(row)) values[row] = std::numeric_limits<double>::quiet_NaN();
    return values;
  }

  MetricSummary distribution(const Metric& metric, const std::vector<double>& values) const {
    std::vector<double> rising;
    for (std::size_t row = 0; row < values.size(); ++row)
      if (counts(row) && std::isfinite(values[row])) rising.push_back(values[row]);
    std::sort(rising.begin(), rising.end());
    MetricSummary summary;
    summary.metric = metric;
    summary.count = rising.size();
    if (rising.empty()) return summary;
    const auto n = static_cast<double>(rising.size());
    summary.mean = std::accumulate(rising.begin(), rising.end(), 0.0) / n;
    double squares = 0.0;
    for (const double value : rising) squares += (value - summary.mean) * (value - summary.mean);
    summary.deviation = rising.size() > 1 ? std::sqrt(squares / (n - 1.0)) : 0.0;
    summary.least = rising.front();
    summary.greatest = rising.back();
    for (const double p : summary_quantiles) summary.quantiles.push_back(sample_quantile(rising, p));
    return summary;
  }

  ThresholdSummary missed(const Threshold& threshold, const Unit& unit, const std::vector<double>& values) const {
    ThresholdSummary summary{threshold, unit, 0, 0, {}};
    for (std::size_t row = 0; row < values.size(); ++row)
      if (counts(row) && done(row)) {
        ++summary.of;
        if (threshold.missed_by(values[row])) ++summary.missed;
      }
    summary.share = probability(summary.missed, summary.of);
    return summary;
  }

  void note_condition(const Metric& metric, const std::vector<double>& margins, SweepSummary& summary) const {
    ConditionSummary condition{metric.meaning, 0, 0};
    for (std::size_t row = 0; row < margins.size(); ++row)
      if (counts(row) && done(row)) {
        ++condition.of;
        if (margins[row] < 0.0) ++condition.trials;
      }
    summary.conditions.push_back(condition);
  }

  void rank(const std::vector<double>& values, unsigned worst, SweepSummary& summary) const {
    std::vector<std::size_t> rows;
    for (std::size_t row = 0; row < values.size(); ++row)
      if (std::isfinite(values[row])) rows.push_back(row);
    influences(values, rows, summary);
    const double sign = worse(study_, ranked_by_);
    const auto end = rows.begin() + static_cast<std::ptrdiff_t>(std::min<std::size_t>(worst, rows.size()));
    std::partial_sort(rows.begin(), end, rows.end(), [&](std::size_t a, std::size_t b) {
      return std::pair(-sign * values[a], a) < std::pair(-sign * values[b], b);
    });
    for (auto row = rows.begin(); row != end; ++row) {
      const std::uint64_t trial = sweep_.range().first + *row;
      summary.worst.push_back(sweep_.read({trial, trial + 1}).front());
    }
  }

  void influences(const std::vector<double>& values, const std::vector<std::size_t>& rows,
                  SweepSummary& summary) const {
    std::vector<SobolIndex> sobol;
    if (stride_ > 1 && sweep_.range().first == 0) sobol = sobol_indices(values, study_.parameters.size(), study_.seed);
    const auto of_rows = [&](const std::vector<double>& column) {
      std::vector<double> chosen;
      for (const std::size_t row : rows)
        if (counts(row)) chosen.push_back(column[row]);
      return Ranks(chosen);
    };
    const Ranks metric = of_rows(values);
    for (std::size_t k = 0; k < study_.parameters.size(); ++k) {
      Influence influence{study_.parameters[k].path, 0.0, {}};
      influence.rank_correlation = metric.correlation(of_rows(sweep_.column(study_.parameters[k].name)));
      if (!sobol.empty()) influence.sobol = sobol[k];
      summary.influences.push_back(std::move(influence));
    }
    std::stable_sort(summary.influences.begin(), summary.influences.end(),
                     [](const Influence& a, const Influence& b) { return a.size() > b.size(); });
  }

  const SweepReader& sweep_;
  const Study& study_;
  std::string ranked_by_;
  std::vector<double> status_;
  std::size_t stride_ = 1;
};

}  // namespace

std::string default_ranking(const Study& study) {
  return study.thresholds.empty() ? study.metrics.front().name : study.thresholds.front().metric;
}

double worse(const Study& study, const std::string& metric) {
  const bool below = std::any_of(study.thresholds.begin(), study.thresholds.end(),
                                 [&](const Threshold& t) { return t.metric == metric && !t.above; });
  return below ? -1.0 : 1.0;
}

SweepSummary summarise(const SweepReader& sweep, const std::string& ranked_by, unsigned worst) {
  return Summariser(sweep, ranked_by)(worst);
}

}  // namespace wormdrive
