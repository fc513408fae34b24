#pragma once
#include <array>
#include <cmath>

#include "bench/plant.hpp"

namespace bench {

/// The limit: one series step per sample in the mode that its beginning suggests, events ignored. Not a simulation of
/// this drive, but no simulation of it can do less.
class BareLoop {
 public:
  using Drive = Plant<closed_loop, double>;

  explicit BareLoop(double /*tolerance*/) {}

  void begin() {
    t_ = 0.0;
    y_ = {0.0, 0.0};
    steps_ = 0;
  }
  void hold(double torque, double) { drive_.held = torque; }

  void advance(double end, double) {
    const double sine = std::sin(y_[0]), cosine = std::cos(y_[0]), w = y_[1];
    const double load = closed_loop.load_sine;
    const bool left = drive_.held <= drive_.surface * (load * sine),
               forward = w > 0.0 || (w == 0.0 && drive_.held > 0.0);
    const bool first = left == forward;
    const double per_inertia = 1.0 / (first ? drive_.J1 : drive_.J2);
    const double swing = (first ? drive_.C1 : drive_.C2) * load * per_inertia;
    // successive derivatives of the speed
    const double a = drive_.held * per_inertia + swing * sine, b = swing * cosine * w;
    const double c = swing * (cosine * a - sine * w * w), d = swing * (cosine * (b - w * w * w) - 3.0 * sine * w * a);
    const double h = end - t_;
    y_[0] += h * (w + h * (a * (1.0 / 2) + h * (b * (1.0 / 6) + h * (c * (1.0 / 24) + h * d * (1.0 / 120)))));
    y_[1] += h * (a + h * (b * (1.0 / 2) + h * (c * (1.0 / 6) + h * d * (1.0 / 24))));
    t_ = end;
    ++steps_;
  }

  double t() const { return t_; }
  const std::array<double, 2>& y() const { return y_; }
  long evaluations() const { return steps_; }
  int events() const { return 0; }

 private:
  Drive drive_;
  double t_ = 0.0;
  std::array<double, 2> y_{0.0, 0.0};
  long steps_ = 0;
};

}  // namespace bench
