#pragma once
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "description/build.hpp"
#include "diagnosis/logger.hpp"
#include "support.hpp"

namespace wormdrive::test {

/// The bench of eight logs of a small servo with a pendulum, 6 s each at 190 to 280 Hz in steps that vary by a third:
/// Rhoban/bam, Duclusaud and Passault, 2025. What rotates in the servo is part of the inertia.
inline Scenario pendulum() {
  Scenario s;
  s.mesh = SingleInertia<double>{1.643e-3 + 0.49 * 0.1 * 0.1};
  GravityArm arm;
  arm.mass = 0.49;
  arm.arm = 0.1;
  arm.offset = 0.5 * std::numbers::pi;
  s.load = arm;
  return s;
}

inline constexpr double servo_kt = 0.3232, servo_ohm = 4.764;  ///< published, at the output [N m/A, ohm]

/// The same with the back-EMF of its motor, which brakes like a viscous bearing.
inline Scenario pendulum_with_back_emf() {
  Scenario s = pendulum();
  std::get<std::optional<WormViscous<double>>>(s.effects.list) = {servo_kt * servo_kt / servo_ohm};
  return s;
}

/// The published model M1: friction that depends on no load.
inline Scenario published_servo() {
  Scenario s = pendulum();
  std::get<std::optional<WormCoulomb<double>>>(s.effects.list) = {6.97e-3};
  std::get<std::optional<WormViscous<double>>>(s.effects.list) = {1.0495e-2 + servo_kt * servo_kt / servo_ohm};
  std::get<GravityArm>(s.load).offset += 0.01795;
  return s;
}

/// The pendulum with its gearbox stated as a worm gear of the same ratio, which its load drives back.
inline Scenario geared_pendulum() {
  Scenario s = pendulum();
  MeshParameters<double> mesh;
  mesh.i = 288.35;
  mesh.lambda = 3.0 * std::numbers::pi / 180.0;
  mesh.phi_n = 20.0 * std::numbers::pi / 180.0;
  mesh.lw = 0.003;
  mesh.lg = mesh.i * mesh.lw * std::tan(mesh.lambda);
  mesh.mu = 0.01;
  mesh.Jw = 1.643e-3 / (mesh.i * mesh.i);
  mesh.Jg = 0.49 * 0.1 * 0.1;
  s.mesh = mesh;
  return s;
}

/// Names of the logs of a gain, kp100 or kp400: four motions.
inline std::vector<std::string> servo_logs(const std::string& gain) {
  std::vector<std::string> all;
  for (const char* motion : {"lift_and_drop", "sin_sin", "sin_time_square", "up_and_down"})
    all.push_back(fmt::format("xl330/{}_{}.csv", motion, gain));
  return all;
}

/// A log as a recording: the published constants make a torque at standstill of its PWM, at the worm where the scenario
/// has one. Nothing without reference data.
inline std::optional<Recording> servo_recording(const std::string& name, const Scenario& scenario) {
  const auto log = reference(name);
  if (!log) return std::nullopt;
  constexpr double full = 885.0;
  const double ratio = stated_mesh(scenario).i;
  Sheet sheet{{"time_s", "motor_torque_Nm", "gear_angle_rad"}, {}};
  for (std::size_t k = 0; k < log->size(); ++k)
    sheet.rows.push_back({log->text("time_s", k),
                          fmt::format("{:.9g}", servo_kt / servo_ohm * log->number("supply_V", k) *
                                                    log->number("pwm", k) / full / ratio),
                          log->text("position_rad", k)});
  return read(Folder(), sheet, scenario);
}

}  // namespace wormdrive::test
