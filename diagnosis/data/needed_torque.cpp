#include "diagnosis/data/needed_torque.hpp"

#include <algorithm>
#include <cmath>

#include "description/build.hpp"
#include "diagnosis/rules/recordings.hpp"

namespace wormdrive {

std::size_t slope_half_width(double period) {
  return static_cast<std::size_t>(std::max(rules::least_half_width, std::lround(rules::slope_half_width / period)));
}

MeasuredMotion measured_motion(const std::vector<double>& angle, double period, std::size_t half_width) {
  const auto n = static_cast<long>(angle.size()), w = static_cast<long>(half_width);
  MeasuredMotion motion{angle, std::vector<double>(angle.size()), std::vector<double>(angle.size())};
  if (n < 2 * w + 1) return motion;
  double squares = 0.0, fourth = 0.0;
  for (long j = -w; j <= w; ++j) squares += static_cast<double>(j * j);
  const double mean_square = squares / static_cast<double>(2 * w + 1);
  for (long j = -w; j <= w; ++j) fourth += std::pow(static_cast<double>(j * j) - mean_square, 2);
  for (long k = 0; k < n; ++k) {
    const long middle = std::clamp(k, w, n - 1 - w);
    double slope = 0.0, bend = 0.0;
    for (long j = -w; j <= w; ++j) {
      // from the middle's own angle: differences lose no digits
      const double y = angle[static_cast<std::size_t>(middle + j)] - angle[static_cast<std::size_t>(middle)];
      slope += static_cast<double>(j) * y;
      bend += (static_cast<double>(j * j) - mean_square) * y;
    }
    motion.speed[static_cast<std::size_t>(k)] = slope / (squares * period);
    motion.acceleration[static_cast<std::size_t>(k)] = 2.0 * bend / (fourth * period * period);
  }
  return motion;
}

std::vector<double> needed_torque(const Scenario& scenario, const MeasuredMotion& motion,
                                  const std::vector<double>& time, double still) {
  std::vector<double> torque(motion.angle.size(), 0.0);
  Scenario free = scenario;
  free.motor = {};
  auto drive = make_drive(free);
  for (std::size_t k = 0; k < torque.size(); ++k) {
    const double v = motion.speed[k], a = motion.acceleration[k];
    if (std::abs(v) < still) continue;
    const Motion direction = v > 0.0 ? Motion::forward : Motion::backward;
    const double t = time[k];
    drive.enter(t);
    const auto at = drive.moment(t, motion.angle[k], v);
    const auto sides = drive.side_torques(at, direction);
    const double through_teeth = sides.gear - drive.Jg() * a;
    const Flank flank = !drive.mesh().has_teeth ? Flank::none : through_teeth >= 0.0 ? Flank::left : Flank::right;
    const double C = drive.mesh().C(drive.signed_friction(at, Mode{direction, flank}));
    torque[k] = drive.mesh().Jw * drive.mesh().i * a - C * through_teeth - sides.worm;
  }
  return torque;
}

double largest_acceleration(const Scenario& scenario, double torque) {
  auto drive = make_drive(scenario);
  drive.enter(0.0);
  double load = 0.0;
  for (int k = 0; k < 16; ++k) {
    const auto at = drive.moment(0.0, 0.4 * k, 0.0);
    load = std::max(load, std::abs(drive.side_torques(at, Motion::stuck).gear));
  }
  const auto& mesh = drive.mesh();
  if (!mesh.has_teeth) return (torque + load) / drive.Jg();
  const double inertia = std::max(mesh.Jw * mesh.i + mesh.C1() * drive.Jg(), 0.1 * mesh.Jw * mesh.i);
  return (torque + std::abs(mesh.C2()) * load) / inertia;
}

}  // namespace wormdrive
