#pragma once
#include <atomic>
#include <optional>
#include <vector>

#include "diagnosis/candidates/coordinates.hpp"
#include "diagnosis/points/torque_points.hpp"

namespace wormdrive {

/// Effects that a fit moves, out of a scenario.
struct PointModel {
  std::vector<Coordinate> coordinates;
  std::vector<std::string_view> causes;  ///< ids of the effects under trial; the other coordinates are always there

  bool holds(std::string_view effect) const;
};

/// What a fit comes to.
struct PointFit {
  std::vector<double> values;   ///< of the coordinates, in SI
  double scale = 0.0;           ///< of Student's t, in deviations of the points
  double nll = 0.0;             ///< of the fitted points and of the tolerances [nats]
  std::vector<double> torques;  ///< at all points [N m]
};

/// Which points a fit sees.
enum class Part { all, first_half, second_half };

/// How long a fit goes on.
struct Effort {
  int rounds = 8;           ///< between the parameters and the scale
  double gain = 1e-3;       ///< stops when a round wins no more [nats]
  double tolerance = 1e-8;  ///< of the cost in one round
  bool central = true;      ///< differences, else forward ones
};
inline constexpr Effort thorough{}, quick{4, 1e-2, 1e-5, false};

/// Fits models to torque points by maximum likelihood: Student's t about the points, normal tolerances about what the
/// scenario states.
class PointFitter {
 public:
  PointFitter(const Scenario& scenario, const TorquePoints& points) : scenario_(scenario), points_(points) {}

  /// The best fit from several starts; nothing if the model has torques at none of them.
  std::optional<PointFit> fit(const PointModel& model, const std::vector<std::vector<double>>& starts, Part part,
                              const Effort& effort = thorough) const;

  /// Negative log likelihood of the points that a fit did not see [nats].
  double held_out(const PointFit& fit, Part fitted) const;
  /// Errors of all points [N m].
  std::vector<double> errors(const std::vector<double>& torques) const;
  /// The scenario's effects with the values of a model.
  Effects<double> with(const PointModel& model, const std::vector<double>& values) const;
  /// Change of all torques per scale of each coordinate, by differences [N m], points x coordinates.
  std::vector<std::vector<double>> slopes(const PointModel& model, const std::vector<double>& values) const;

  const Scenario& scenario() const { return scenario_; }
  const TorquePoints& points() const { return points_; }
  long passes() const { return passes_; }

 private:
  std::optional<PointFit> fit_once(const PointModel& model, std::vector<double> start, Part part,
                                   const Effort& effort) const;

  const Scenario& scenario_;
  const TorquePoints& points_;
  mutable std::atomic<long> passes_{0};
};

}  // namespace wormdrive
