#include "diagnosis/candidates/magnitudes.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "description/build.hpp"
#include "diagnosis/data/impossible_samples.hpp"
#include "diagnosis/data/moved_load.hpp"

namespace wormdrive {

namespace {

std::array<double, 3> rare_torques(const std::vector<PreparedRecording>& recordings) {
  std::vector<double> sizes;
  for (const PreparedRecording& r : recordings)
    for (const double u : r.data.motor_torque) sizes.push_back(std::abs(u));
  std::array<double, 3> rare{};
  constexpr std::array<double, 3> shares{0.004, 0.015, 0.05};
  for (std::size_t k = 0; k < shares.size() && !sizes.empty(); ++k) {
    const auto at = static_cast<std::size_t>((1.0 - shares[k]) * static_cast<double>(sizes.size() - 1));
    std::nth_element(sizes.begin(), sizes.begin() + static_cast<std::ptrdiff_t>(at), sizes.end());
    rare[k] = sizes[at];
  }
  return rare;
}

/// The time in which the correlation of a torque with itself falls to a half [s].
double torque_memory(const Recording& r) {
  const std::vector<double>& u = r.motor_torque;
  const double mean = std::accumulate(u.begin(), u.end(), 0.0) / static_cast<double>(u.size());
  const auto product = [&](std::size_t lag) {
    double sum = 0.0;
    for (std::size_t k = lag; k < u.size(); ++k) sum += (u[k] - mean) * (u[k - lag] - mean);
    return sum;
  };
  const double half = 0.5 * product(0);
  std::size_t lag = 1;
  while (lag < u.size() / 2 && product(lag) > half) lag += 1 + lag / 4;
  return static_cast<double>(lag) * r.period;
}

}  // namespace

Magnitudes magnitudes(const Scenario& scenario, const std::vector<PreparedRecording>& recordings) {
  Magnitudes m;
  for (const PreparedRecording& r : recordings) {
    m.torque = std::max(m.torque, r.rms_torque);
    m.largest_torque = std::max(m.largest_torque, r.largest_torque);
    m.gear_speed = std::max(m.gear_speed, r.rms_speed);
    m.duration = std::max(m.duration, r.duration());
    const double memory = torque_memory(r.data);
    m.torque_memory = m.torque_memory > 0.0 ? std::min(m.torque_memory, memory) : memory;
    m.period = std::max(m.period, r.data.period);
    m.has_worm_encoder = m.has_worm_encoder || r.data.has_worm_encoder();
  }
  m.rare_torques = rare_torques(recordings);
  const GearMesh<double> mesh = stated_mesh(scenario);
  m.has_teeth = mesh.has_teeth;
  m.worm_speed = mesh.i * m.gear_speed;
  m.worm_inertia = mesh.has_teeth ? mesh.Jw : mesh.Jg;
  if (mesh.has_teeth) {
    m.stated_friction = mesh.mu;
    m.friction = std::max(mesh.mu, std::tan(mesh.lambda) * std::cos(mesh.phi_n));
    m.widest_gap = widest_gap(mesh.i);
    m.gear_arm = mesh.gear_arm(0.0);
    m.sliding_speed = mesh.sliding_speed(m.worm_speed);
    m.gear_inertia = total_gear_inertia(scenario);
  }
  for (const PreparedRecording& r : recordings) {
    const auto drive = loaded_drive(scenario, r.data);
    auto load = drive.load();
    m.load_turns = m.load_turns || load.ripple() > 0.0;
    for (std::size_t k = 0; k < r.samples(); k += 50) {
      const double t = r.data.time(k);
      load.enter(t);
      const double tau = load.torque(drive.moment(t, r.data.gear_angle[k], r.speed[k]));
      m.load_torque = std::max(m.load_torque, std::abs(tau));
    }
  }
  return m;
}

}  // namespace wormdrive
