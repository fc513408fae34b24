#pragma once
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "description/scenario.hpp"
#include "sweep/metrics/metric.hpp"
#include "sweep/metrics/own_metric.hpp"
#include "sweep/study/correlation.hpp"
#include "sweep/study/design.hpp"
#include "sweep/study/distribution.hpp"

namespace wormdrive {

/// A number of the scenario that is uncertain.
struct UncertainParameter {
  std::string path;  ///< as --set takes it, "effect.mesh_friction.change"
  std::string name;  ///< without the unit
  Unit si_unit;
  Distribution
      distribution;  ///< in the unit of the path; where the design goes by levels, of discrete values each once
};

/// A limit that a metric should keep.
struct Threshold {
  std::string metric;
  double limit{};      ///< SI
  bool above = true;   ///< it is missed above the limit, else below
  double until = 0.0;  ///< the sweep may end when half of the interval is this share of the share missed; 0: never

  /// A value that is not a number keeps no limit.
  bool missed_by(double value) const { return !(above ? value <= limit : value >= limit); }
};

/// Of which trials the trajectories are kept.
struct Kept {
  std::vector<std::uint64_t> trials;
  std::uint64_t worst = 0;  ///< so many
  std::string worst_by;     ///< by this metric; empty: the one by which trials are ranked
};

/// A sweep as it is stated: one scenario, what is uncertain in it, and what is asked of it; plain data.
struct Study {
  std::string title;
  Scenario scenario;  ///< every uncertain number at its median
  std::vector<UncertainParameter> parameters;
  Copula copula;
  DesignSettings design;
  std::shared_ptr<const CorrelatedStrata> strata;  ///< of a Latin hypercube with correlations, which the copula spoils
  std::uint64_t seed = 0;
  bool common_random_numbers = false;  ///< all trials have the noise of the scenario, instead of each its own
  std::vector<Metric> metrics;
  std::vector<OwnMetric> own_metrics;  ///< of columns of the runs; each is among the metrics
  std::vector<Threshold> thresholds;
  Kept kept;
  double referee_tolerance = 1e-6;  ///< of the gear angle [rad], beyond which the referee disagrees

  std::string text;           ///< of the study file
  std::string scenario_file;  ///< from which the scenario was read; empty: from somewhere else
  bool varies(std::string_view path) const {
    return std::any_of(parameters.begin(), parameters.end(), [&](const auto& p) { return p.path == path; });
  }
  /// The parameter whose coordinate of the unit cube each has: its own, or the first one's with which it is drawn by
  /// rows of a file.
  std::vector<std::size_t> drawn_with() const {
    std::vector<std::size_t> list;
    for (std::size_t k = 0; k < parameters.size(); ++k) {
      std::size_t first = 0;
      while (first < k && !are_of_one_row(parameters[first].distribution, parameters[k].distribution)) ++first;
      list.push_back(first);
    }
    return list;
  }
  /// A parameter that is drawn by rows of a file, if there is one.
  const UncertainParameter* drawn_by_rows() const {
    const auto is_row = [](const UncertainParameter& p) { return std::holds_alternative<RowOfFile>(p.distribution); };
    const auto found = std::find_if(parameters.begin(), parameters.end(), is_row);
    return found == parameters.end() ? nullptr : &*found;
  }
  /// The place of one of its metrics.
  std::size_t place_of(std::string_view metric) const {
    const auto named = [&](const Metric& m) { return m.name == metric; };
    return static_cast<std::size_t>(std::find_if(metrics.begin(), metrics.end(), named) - metrics.begin());
  }
  const Metric& metric(std::string_view name) const { return metrics[place_of(name)]; }
  /// Whether the points of the design have the correlations already.
  bool has_correlated_points() const { return strata || std::holds_alternative<Shapley>(design); }
  /// At most, where it may end before.
  std::uint64_t trials() const { return size(design, parameters.size()); }
  bool may_end_early() const {
    return std::any_of(thresholds.begin(), thresholds.end(), [](const Threshold& t) { return t.until > 0.0; });
  }
};

}  // namespace wormdrive
