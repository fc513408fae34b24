#pragma once
#include <vector>

#include "diagnosis/points/fit.hpp"

namespace wormdrive {

/// An effect that torque points may show.
struct PointCandidate {
  std::string_view effect;
  std::vector<Coordinate> coordinates;
  std::vector<std::vector<double>> starts;  ///< values of the coordinates
  bool tolerated = false;                   ///< a stated parameter: its tolerance lets every model move it a little
  std::string_view excludes{};              ///< an effect that says the same in another way
  bool falls = false;                       ///< its size is a fall: where it rises, another effect has a name for it
};

/// Every effect of the catalogue that changes torques at constant speed or at break-in.
std::vector<PointCandidate> point_candidates(const Scenario& scenario, const TorquePoints& points);

/// The model in which only the stated parameters move, each within its tolerance.
PointModel calibration(const std::vector<PointCandidate>& candidates);

/// A model with one more effect; of a stated parameter the tolerance goes.
PointModel with_cause(const PointModel& model, const PointCandidate& candidate);

/// A model without one of its effects; a stated parameter gets its tolerance back.
PointModel without_cause(const PointModel& model, const PointCandidate& candidate);

}  // namespace wormdrive
