#pragma once
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "events/polynomial_root.hpp"
#include "events/solver_settings.hpp"
#include "events/taylor_expansion.hpp"

namespace wormdrive {

/// Base-2 logarithm to within 0.09, and its exact inverse, from the bits of a double: the same on every machine.
inline double rough_log2(double x) { return static_cast<double>(std::bit_cast<std::int64_t>(x)) * 0x1p-52 - 1023.0; }
inline double rough_exp2(double y) {
  return std::bit_cast<double>(static_cast<std::int64_t>((std::clamp(y, -1000.0, 1000.0) + 1023.0) * 0x1p52));
}

/// How far a power series is carried, and over which step.
///
/// The tolerances are errors per second of simulated time, so that the error of a run does not depend on into how
/// many steps reports and samples cut it.
struct TaylorAccuracy {
  double absolute;  ///< of the speed [rad/s]
  double relative;
  int order;        ///< of the speed, where the step is free

  explicit TaylorAccuracy(const SolverSettings& settings)
      : absolute(std::max(settings.absolute_tolerance, 1e-18)),
        relative(std::max(settings.relative_tolerance, 1e-16)),
        order(std::clamp(static_cast<int>(std::ceil(2.0 - 0.35 * std::ilogb(relative))), 8, highest_order - 1)) { if (getenv("ORD")) order=atoi(getenv("ORD"));}

  /// Error of the speed [rad/s] that a second may bring.
  double allowed(double speed) const { return absolute + relative * std::abs(speed); }

  /// Coefficients whose terms a step is judged by. A motion from rest under a ramp may have four in a row that vanish.
  static constexpr int window = 6;

  static constexpr auto per_root = [] {
    std::array<double, most_coefficients> r{};
    for (std::size_t k = 1; k < r.size(); ++k) r[k] = 1.0 / static_cast<double>(k);
    return r;
  }();

  /// The step within h over which the last terms of the speed stay below what is allowed.
  double step(Polynomial omega, double h) const {
    const int n = static_cast<int>(omega.size()) - 1;
    const double allowed_log2 = rough_log2(allowed(omega[0]));
    double log2_step = rough_log2(h);
    for (int j = std::max(2, n + 1 - window); j <= n; ++j) {
      // Terms fall by at least 2^4 each. That lets earlier ones count where the last happen to vanish.
      const double size = rough_log2(std::abs(omega[static_cast<std::size_t>(j)]));
      log2_step = std::min(log2_step, (allowed_log2 + 4.0 * (n - j) - size) * per_root[static_cast<std::size_t>(j - 1)]);
    }
    return std::min(h, rough_exp2(log2_step));
  }

  /// A step within h over which the last two terms of a guard are negligible next to the others.
  double step_of_guard(Polynomial guard, double h) const {
    for (int shorter = 0; shorter < 16; ++shorter, h *= 0.8) {
      double sum = 0.0, last = 0.0, before = 0.0, power = 1.0;
      for (const double c : guard) {
        before = last;
        sum += last = std::abs(c) * power;
        power *= h;
      }
      if (!(std::max(before, last) > relative * sum)) break;
    }
    return h;
  }

  /// Whether the last terms of the speed are below what is allowed over a step of h.
  bool suffices(Polynomial omega, double h) const {
    const int n = static_cast<int>(omega.size()) - 1;
    if (n < window + 1) return false;
    double power = h;
    for (int j = 3; j <= n - window + 1; ++j) power *= h;
    for (int j = n - window + 1; j <= n; ++j, power *= h)  // power = h^(j-1)
      if (!(std::abs(omega[static_cast<std::size_t>(j)]) * power <= allowed(omega[0]))) return false;
    return true;
  }
};

}  // namespace wormdrive
