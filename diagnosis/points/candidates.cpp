#include "diagnosis/points/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/place.hpp"
#include "description/build.hpp"
#include "statistics/sizes.hpp"

namespace wormdrive {
namespace {

double largest(const std::vector<double>& values) {
  double size = 0.0;
  for (const double value : values) size = std::max(size, std::abs(value));
  return size;
}

double least(const std::vector<double>& values) {
  double size = std::numeric_limits<double>::infinity();
  for (const double value : values) size = std::min(size, std::abs(value));
  return size;
}

/// Makes candidates whose sizes fit the data.
class Maker {
 public:
  explicit Maker(const Scenario& scenario) : effects_(scenario.effects) {}

  /// reach: beyond -reach and reach a value is not believed.
  Coordinate coordinate(std::string_view effect, std::string_view field, double scale, double reach,
                        double tolerance = 0.0) const {
    const FieldOfEffect found = field_of(effects_, effect, field);
    const double centre = found.on ? found.value : 0.0;
    return {.effect = effect,
            .field = field,
            .scale = scale,
            .low = std::max(found.bounds.low, centre - reach),
            .high = std::min(found.bounds.high, centre + reach),
            .centre = centre,
            .tolerance = tolerance};
  }
  bool states(std::string_view effect, std::string_view field) const { return field_of(effects_, effect, field).on; }
  void add(std::vector<Coordinate> coordinates, std::vector<std::vector<double>> starts = {}) {
    if (starts.empty()) {  // as stated, but off the bound: there a step may lead nowhere
      starts.emplace_back();
      for (const Coordinate& c : coordinates)
        starts.back().push_back(c.low == c.centre ? c.centre + 0.3 * c.scale : c.centre);
    }
    const bool tolerated = coordinates.front().tolerance > 0.0;
    if (tolerated)  // the best value may lie far from what is stated, behind worse ones
      for (const double share : {-0.3, 0.3})
        starts.push_back({(1.0 - std::abs(share)) * coordinates.front().centre +
                          share * (share > 0.0 ? coordinates.front().high : -coordinates.front().low)});
    list_.push_back({coordinates.front().effect, std::move(coordinates), std::move(starts), tolerated, {}, false});
  }
  /// Of the candidate that was added last.
  void exclude(std::string_view effect) { list_.back().excludes = effect; }
  void fall() { list_.back().falls = true; }
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
  const auto one = [&](std::string_view effect, std::string_view field, double scale, double reach,
                       double stated = 0.0) { maker.add({maker.coordinate(effect, field, scale, reach, stated)}); };
  one("torque_gain", "share", 0.1, 0.5, tolerance.torque_gain);
  one("torque_offset", "torque", torque, torque, tolerance.torque_offset.value_or(0.01 * torque));
  one("worm_coulomb", "torque", torque, 2.0 * torque);
  if (load > 0.0) one("load_magnitude", "share", 0.1, 0.9, tolerance.load);
  if (speed > 0.0) one("worm_viscous", "coefficient", torque / speed, 2.0 * torque / speed);
  if (!mesh.has_teeth) return maker.take();
  const double mu = std::max(0.01, mesh.mu), gear = std::max(load, torque);
  one("mesh_friction", "change", mu, 0.5, tolerance.friction * mu);
  one("friction_asymmetry", "change", mu, mu);
  one("gear_coulomb", "torque", gear, 2.0 * gear);
  if (speed > 0.0) {
    const double v = std::abs(mesh.sliding_speed(speed)),
                 slowest = std::abs(mesh.sliding_speed(least(points.worm_speed)));
    Coordinate at = maker.coordinate("stribeck", "speed", 0.1 * v, 2.0 * v);
    at.low = 0.1 * slowest;  // slower, and the data have seen the fall's end only
    at.centre = 0.1 * v;
    std::vector<std::vector<double>> starts;
    for (const double share : {0.005, 0.02, 0.1, 0.5}) starts.push_back({0.1 * mu, std::max(2.0 * at.low, share * v)});
    // both say how friction falls with the sliding speed
    if (!maker.states("agma", "scale")) {
      maker.add({maker.coordinate("stribeck", "drop", mu, 0.5), at}, starts);
      maker.exclude("agma");
      maker.fall();
    }
    if (!maker.states("stribeck", "drop")) {
      maker.add({maker.coordinate("agma", "scale", 1.0, 10.0)}, {{mu / 0.15}});
      maker.exclude("stribeck");
    }
    one("gear_viscous", "coefficient", gear * mesh.i / speed, 2.0 * gear * mesh.i / speed);
  } else {
    one("static_friction", "rise", mu, 0.5);
  }
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
