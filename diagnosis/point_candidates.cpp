#include "diagnosis/point_candidates.hpp"

#include <algorithm>
#include <cmath>

#include "core/place.hpp"
#include "scenarios/build.hpp"

namespace wormdrive {
namespace {

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double largest(const std::vector<double>& values) {
  double size = 0.0;
  for (const double value : values) size = std::max(size, std::abs(value));
  return size;
}

/// Makes candidates whose sizes fit the data.
class Maker {
 public:
  explicit Maker(const Scenario& scenario) : effects_(scenario.effects) {}

  Coordinate coordinate(std::string_view effect, std::string_view field, double scale, double tolerance = 0.0) const {
    const FieldOfEffect found = field_of(effects_, effect, field);
    return {effect,
            field,
            scale,
            found.bounds.low_exclusive ? found.bounds.low + 1e-6 * scale : found.bounds.low,
            found.bounds.high,
            CoordinateForm::plain,
            found.on ? found.value : 0.0,
            tolerance};
  }
  void add(std::vector<Coordinate> coordinates, std::vector<std::vector<double>> starts = {}) {
    if (starts.empty()) {  // as stated; one that is off from zero
      starts.emplace_back();
      for (const Coordinate& c : coordinates) starts.back().push_back(c.centre);
    }
    const bool tolerated = coordinates.front().tolerance > 0.0;
    list_.push_back({coordinates.front().effect, std::move(coordinates), std::move(starts), tolerated});
  }
  std::vector<PointCandidate> take() { return std::move(list_); }

 private:
  const Effects<double>& effects_;
  std::vector<PointCandidate> list_;
};

}  // namespace

std::vector<PointCandidate> point_candidates(const Scenario& scenario, const TorquePoints& points) {
  const Tolerances tolerance = scenario.tolerance.value_or(Tolerances{});
  const GearMesh<double> mesh = stated_mesh(scenario);
  const double torque = rms(points.torque), load = rms(points.load_torque), speed = largest(points.worm_speed);
  Maker maker(scenario);
  maker.add({maker.coordinate("torque_gain", "share", 0.1, tolerance.torque_gain)});
  maker.add({maker.coordinate("torque_offset", "torque", torque, tolerance.torque_offset.value_or(0.01 * torque))});
  maker.add({maker.coordinate("worm_coulomb", "torque", torque)});
  if (load > 0.0) maker.add({maker.coordinate("load_magnitude", "share", 0.1, tolerance.load)});
  if (mesh.has_teeth) {
    const double mu = std::max(0.01, mesh.mu);
    maker.add({maker.coordinate("mesh_friction", "change", mu, tolerance.friction * mu)});
    maker.add({maker.coordinate("friction_asymmetry", "change", mu)});
    maker.add({maker.coordinate("gear_coulomb", "torque", std::max(load, torque))});
    if (speed > 0.0) {
      const double v = std::abs(mesh.sliding_speed(speed));
      maker.add({maker.coordinate("stribeck", "drop", mu), maker.coordinate("stribeck", "speed", 0.1 * v)},
                {{0.1 * mu, 0.005 * v}, {0.1 * mu, 0.02 * v}, {0.1 * mu, 0.1 * v}, {0.1 * mu, 0.5 * v}});
      maker.add({maker.coordinate("agma", "scale", 1.0)}, {{mu / 0.15}});
      maker.add({maker.coordinate("gear_viscous", "coefficient", std::max(load, torque) * mesh.i / speed)});
    } else {
      maker.add({maker.coordinate("static_friction", "rise", mu)});
    }
  }
  if (speed > 0.0) maker.add({maker.coordinate("worm_viscous", "coefficient", torque / speed)});
  return maker.take();
}

PointModel calibration(const std::vector<PointCandidate>& candidates) {
  PointModel model;
  for (const PointCandidate& candidate : candidates)
    if (candidate.tolerated)
      model.coordinates.insert(model.coordinates.end(), candidate.coordinates.begin(), candidate.coordinates.end());
  return model;
}

PointModel with_cause(const PointModel& model, const PointCandidate& candidate) {
  PointModel wider = model;
  wider.causes.push_back(candidate.effect);
  for (const Coordinate& c : candidate.coordinates) {
    const auto there = std::find_if(wider.coordinates.begin(), wider.coordinates.end(),
                                    [&](const Coordinate& other) { return other.is(c); });
    if (there == wider.coordinates.end())
      wider.coordinates.push_back(c);
    else
      there->tolerance = 0.0;
  }
  return wider;
}

PointModel without_cause(const PointModel& model, const PointCandidate& candidate) {
  PointModel narrower = model;
  std::erase(narrower.causes, candidate.effect);
  for (const Coordinate& c : candidate.coordinates) {
    const auto there = std::find_if(narrower.coordinates.begin(), narrower.coordinates.end(),
                                    [&](const Coordinate& other) { return other.is(c); });
    if (there == narrower.coordinates.end()) continue;
    if (candidate.tolerated)
      there->tolerance = c.tolerance;
    else
      narrower.coordinates.erase(there);
  }
  return narrower;
}

}  // namespace wormdrive
