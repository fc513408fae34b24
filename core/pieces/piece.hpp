#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/numbers/portable.hpp"
#include "core/numbers/rounded.hpp"

namespace wormdrive {

/// A cos(omega t + phase), t in absolute time.
struct Cosine {
  double amplitude, omega, phase;
};

/// A signal between two of its knots: constant + slope (t - start) + sum of cosines. Smooth, and valid past its end,
/// so that an integrator may look ahead without seeing the next piece.
struct Piece {
  double start = 0.0;
  double constant = 0.0;
  double slope = 0.0;
  std::vector<Cosine> cosines;
  double rounding = 0.0;  ///< of the constant: of terms that cancel each other it is left

  /// Adds a constant.
  void add(double term) {
    constant += term;
    rounding += Rounded::unit * (std::abs(term) + std::abs(constant));
  }

  template <class S>
  S operator()(const S& t) const {
    using portable::cos;
    S value = constant + slope * (t - start);
    for (const Cosine& c : cosines) value += c.amplitude * cos(c.omega * t + c.phase);
    if constexpr (requires { widen(value, rounding); }) widen(value, rounding);
    return value;
  }

  bool is_constant() const { return cosines.empty() && slope == 0.0; }

  /// Highest angular frequency in the piece [rad/s], 0 without cosines.
  double fastest() const {
    double omega = 0.0;
    for (const Cosine& c : cosines) omega = std::max(omega, std::abs(c.omega));
    return omega;
  }
};

}  // namespace wormdrive
