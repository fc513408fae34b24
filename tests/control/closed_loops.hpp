#pragma once
// The closed loop that several tests share: the paper's sliding controller on the drive of fig. 10.
#include <numbers>
#include <utility>

#include "control/closed_loop.hpp"
#include "control/sliding.hpp"
#include "support.hpp"

namespace wormdrive::test {

/// The load 0.0176 sin theta_g, of which the controller believes 0.0196 cos theta_g.
inline GravityArm actual_load() {
  GravityArm arm;
  arm.amplitude = 0.0176;
  arm.offset = -std::numbers::pi / 2.0;
  return arm;
}

inline SlidingController sliding() {
  const GearMesh<double> mesh(table1());
  const NominalModel nominal{
      .C1 = mesh.C1(), .C2 = mesh.C2(), .Jw_i = mesh.Jw * mesh.i, .Jg = mesh.Jg, .load_torque = 0.0196};
  const auto D = [&](double C) { return 0.1 * (C + nominal.surface()) / nominal.inertia(C); };
  const auto E = [&](double C) { return std::abs(C) * 0.02 / nominal.inertia(C); };
  return {{.lambda_c = 30.0 * std::numbers::pi,
           .Phi = 0.3,
           .eta = 30.0,
           .D1 = D(nominal.C1),
           .D2 = D(nominal.C2),
           .E1 = E(nominal.C1),
           .E2 = E(nominal.C2),
           .epsilon = 0.02},
          nominal,
          Variations{}};
}

/// 0.14 sin(4 pi t), exact encoder, speed filtered at 200 Hz; every sample is told to the listener.
template <class Control, class Listener>
auto closed_loop(Control control, const SamplingSettings& sampling, Listener listener) {
  const Reference reference{{SinusoidReference{.amplitude = 0.14, .frequency = 2.0}}};
  return ClosedLoop<Control, Listener>(std::move(control), reference, {.filter_cutoff = 200.0}, sampling, {},
                                       std::move(listener));
}

}  // namespace wormdrive::test
