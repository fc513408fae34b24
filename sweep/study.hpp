#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "scenarios/scenario.hpp"
#include "sweep/correlation.hpp"
#include "sweep/design.hpp"
#include "sweep/distribution.hpp"
#include "sweep/metric.hpp"

namespace wormdrive {

/// A number of the scenario that is uncertain.
struct UncertainParameter {
  std::string path;  ///< as --set takes it, "effect.mesh_friction.change"
  std::string name;  ///< without the unit
  Unit si_unit;
  Distribution distribution;  ///< in the unit of the path
};

/// A limit that a metric should keep.
struct Threshold {
  std::string metric;
  double limit{};     ///< SI
  bool above = true;  ///< it is missed above the limit, else below

  bool missed_by(double value) const { return above ? value > limit : value < limit; }
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
  std::uint64_t seed = 0;
  std::vector<Metric> metrics;
  std::vector<Threshold> thresholds;
  Kept kept;
  double referee_tolerance = 1e-6;  ///< of the gear angle [rad], beyond which the referee disagrees

  std::string text;  ///< of the study file
  std::uint64_t trials() const { return size(design, parameters.size()); }
};

}  // namespace wormdrive
