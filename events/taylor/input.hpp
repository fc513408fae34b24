#pragma once
#include <algorithm>
#include <array>
#include <cmath>

#include "core/motor_input.hpp"
#include "core/numbers/decay.hpp"
#include "core/numbers/series.hpp"
#include "core/numbers/sine_cosine.hpp"
#include "core/pieces/piece.hpp"
#include "events/taylor/polynomial.hpp"

namespace wormdrive {

/// Sets c to the coefficients of so many times an input, up to the last that is asked for.
inline void expand_input(const Piece& piece, double t, int last, double factor, Coefficients& c) {
  std::fill_n(c.begin(), last + 1, 0.0);
  c[0] = piece.constant + piece.slope * (t - piece.start);
  c[1] = piece.slope;
  for (const Cosine& wave : piece.cosines) {
    const SineAndCosine now = sine_and_cosine(wave.omega * t + wave.phase);
    const std::array<double, 4> derivatives{wave.amplitude * now.cosine, -wave.amplitude * now.sine,
                                            -wave.amplitude * now.cosine, wave.amplitude * now.sine};
    double weight = 1.0;  // omega^k / k!
    for (int k = 0; k <= last; ++k) {
      c[k] += weight * derivatives[k % 4];
      weight *= wave.omega * reciprocal[k + 1];
    }
  }
  if (factor != 1.0)
    for (int k = 0; k <= last; ++k) c[k] *= factor;
}

/// Sets c to the coefficients of the torque of a motor, up to the last that is asked for.
inline void expand_torque(const MotorInput<double>& motor, double t, int last, double* c) {
  if (motor.lags() && motor.piece().is_constant()) {
    c[0] = motor(t);
    return expand_decay(motor.decaying(t), motor.lag(), last, c);
  }
  const auto torque = motor(OpenSeries<double>::variable(t, last));
  std::copy_n(torque.c.begin(), last + 1, c);
}

/// The most that the terms of coefficient k may add up to, whatever the phases.
inline double most_of_input(const Piece& piece, double t, int k) {
  double most = k == 0   ? std::abs(piece.constant) + std::abs(piece.slope * (t - piece.start))
                : k == 1 ? std::abs(piece.slope)
                         : 0.0;
  for (const Cosine& wave : piece.cosines) {
    double term = std::abs(wave.amplitude);
    for (int j = 1; j <= k; ++j) term *= std::abs(wave.omega) * reciprocal[j];
    most += term;
  }
  return most;
}

}  // namespace wormdrive
