#pragma once
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "bench/contest.hpp"
#include "bench/worm_drive.hpp"
#include "control/closed_loop.hpp"
#include "control/sliding.hpp"

namespace bench {

using Torques = std::vector<double>;

inline constexpr double duration = 10.0;  ///< of a closed loop [s]

/// What the controller sees of a program that is not wormdrive's.
struct Sensor {
  struct Instant {
    double t;
    std::array<double, 2> x;
  };
  static wormdrive::Moment<double> moment(const Instant& now) { return {now.t, now.x[0], now.x[1], 0.0}; }
  static double measured_angle(const Instant& now) { return now.x[0]; }
  static wormdrive::GearMesh<double> mesh() { return table_1(); }  // of an encoder on the worm, which none has
  static double torque_limit() { return never; }
  static wormdrive::Effects<double> effects() { return {}; }
  static void disturb(double) {}
};

/// The numbers of the sliding controller, and what it believes about the drive.
inline constexpr wormdrive::SlidingParameters fig_10{.lambda_c = 30 * pi, .Phi = 0.3, .eta = 30.0};
inline wormdrive::NominalModel believed() {
  const wormdrive::GearMesh<double> mesh = table_1();
  return {.C1 = mesh.C1(), .C2 = mesh.C2(), .Jw_i = mesh.Jw * mesh.i, .Jg = mesh.Jg, .load_torque = 0.0196};
}

/// The closed loop of fig. 10; every sample is told to the listener.
template <class Listener>
wormdrive::ClosedLoop<wormdrive::SlidingController, Listener> controller(double period, Listener listener) {
  return {wormdrive::SlidingController(fig_10, believed(), wormdrive::Variations{}),
          wormdrive::Reference{{wormdrive::SinusoidReference{.amplitude = 0.14, .frequency = 2.0}}},
          wormdrive::SensorSettings{.filter_cutoff = 200.0},
          wormdrive::SamplingSettings{.period = period},
          wormdrive::DisturbanceSettings{},
          std::move(listener)};
}

/// Torques that were recorded, in the place of a controller.
struct Replay {
  const Torques& torques;
  std::size_t next = 0;

  double sample(const auto&, const auto&) { return torques[next++]; }
};

/// The sampled loop around any program with begin, hold, advance, t and y.
template <class Loop, class Controller>
void run_sampled(Loop& loop, double period, Controller&& control) {
  const long samples = std::lround(duration / period);
  Sensor sensor;
  loop.begin();
  for (long k = 0; k < samples; ++k) {
    const double end = static_cast<double>(k + 1) * period;
    const Sensor::Instant now{static_cast<double>(loop.t()),
                              {static_cast<double>(loop.y()[0]), static_cast<double>(loop.y()[1])}};
    loop.hold(control.sample(sensor, now), end);
    loop.advance(end, end);
  }
}

template <class Loop>
Outcome outcome(const Loop& loop) {
  return {static_cast<double>(loop.y()[0]), static_cast<double>(loop.y()[1]), loop.evaluations(), loop.events()};
}

}  // namespace bench
