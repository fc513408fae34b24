#include "sweep/rare/design_point.hpp"

#include <cmath>

#include <Eigen/Core>

namespace wormdrive {
namespace {

using Vector = Eigen::VectorXd;

constexpr double difference = 1e-3;  ///< of gradients, standard deviations: far above the error of a run
constexpr double near_limit = 1e-4;  ///< of the distance at the median
constexpr double aligned = 1e-3;     ///< standard deviations between the point and the foot of its gradient
constexpr int most_iterations = 50, most_halvings = 10;

NormalPoint as_point(const Vector& u) { return {u.data(), u.data() + u.size()}; }

/// A limit state under one noise.
class Surface {
 public:
  Surface(const LimitState& limit_state, std::uint64_t noise) : limit_state_(limit_state), noise_(noise) {}

  double operator()(const Vector& u) { return at({as_point(u)}).front(); }
  Vector gradient(const Vector& u) {
    std::vector<NormalPoint> points;
    for (Eigen::Index k = 0; k < u.size(); ++k)
      for (const double side : {1.0, -1.0}) {
        points.push_back(as_point(u));
        points.back()[static_cast<std::size_t>(k)] += side * difference;
      }
    const std::vector<double> g = at(points);
    Vector slope(u.size());
    for (Eigen::Index k = 0; k < u.size(); ++k) {
      const auto pair = static_cast<std::size_t>(2 * k);
      slope[k] = (g[pair] - g[pair + 1]) / (2.0 * difference);
    }
    return slope;
  }

  std::uint64_t evaluations = 0;

 private:
  std::vector<double> at(const std::vector<NormalPoint>& points) {
    evaluations += points.size();
    return limit_state_(points, std::vector<std::uint64_t>(points.size(), noise_));
  }

  const LimitState& limit_state_;
  std::uint64_t noise_;
};

}  // namespace

std::uint64_t most_evaluations_for_design_point(std::size_t dimensions) {
  constexpr std::uint64_t beside_gradient = 1 + most_halvings;
  return 1 + most_iterations * (2 * dimensions + beside_gradient);
}

DesignPoint find_design_point(const LimitState& limit_state, std::size_t dimensions, std::uint64_t noise) {
  Surface surface(limit_state, noise);
  Vector u = Vector::Zero(static_cast<Eigen::Index>(dimensions));
  DesignPoint found;
  double g = surface(u);
  const double scale = std::abs(g);
  for (int iteration = 0; iteration < most_iterations && std::isfinite(g); ++iteration) {
    const Vector slope = surface.gradient(u);
    const double steepness = slope.norm();
    if (!(steepness > 0.0) || !std::isfinite(steepness)) break;
    const Vector alpha = -slope / steepness;
    const Vector foot = (alpha.dot(u) + g / steepness) * alpha;
    found.direction = as_point(alpha);
    found.converged = std::abs(g) <= near_limit * scale && (u - alpha.dot(u) * alpha).norm() <= aligned;
    if (found.converged) break;
    // the merit falls along the way to the foot for any weight above |u|/|gradient|
    const double weight = 2.0 * std::max(u.norm(), foot.norm()) / steepness;
    const auto merit = [&](const Vector& v, double state) { return 0.5 * v.squaredNorm() + weight * std::abs(state); };
    const double before = merit(u, g);
    double step = 1.0;
    Vector next = foot;
    double there = surface(next);
    for (int k = 0; k < most_halvings && !(merit(next, there) < before); ++k) {
      step *= 0.5;
      next = u + step * (foot - u);
      there = surface(next);
    }
    u = next;
    g = there;
  }
  found.point = as_point(u);
  found.beta = u.norm();
  found.evaluations = surface.evaluations;
  return found;
}

}  // namespace wormdrive
