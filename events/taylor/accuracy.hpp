#pragma once
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "core/numbers/lanes.hpp"
#include "events/solver_settings.hpp"
#include "events/taylor/expansion.hpp"

namespace wormdrive {

/// Base-2 logarithm to within 0.09, and its exact inverse, from the bits of a double: the same on every machine.
inline double rough_log2(double x) { return static_cast<double>(std::bit_cast<std::int64_t>(x)) * 0x1p-52 - 1023.0; }
inline double rough_exp2(double y) {
  return std::bit_cast<double>(static_cast<std::int64_t>((std::clamp(y, -1000.0, 1000.0) + 1023.0) * 0x1p52));
}

/// How far a power series is carried, and over which step.
///
/// The tolerances are errors per second of simulated time, so that the error of a run does not depend on into how
/// many steps samples and inputs cut it; a step that is longer than a second has the error of one, as with CVODE.
class TaylorAccuracy {
 public:
  /// Coefficients whose terms a step is judged by. A motion from rest under a ramp may have four in a row that vanish.
  static constexpr int window = 6;
  static constexpr int least_order = window + 2;  ///< below which no series is judged

  explicit TaylorAccuracy(const SolverSettings& settings)
      : absolute_(std::max(settings.absolute_tolerance, 1e-18)),
        relative_(std::max(settings.relative_tolerance, 1e-16)),
        order_(std::clamp(static_cast<int>(2.0 - 0.42 * std::ilogb(std::min(relative_, coarsest))), least_order,
                          highest_order)) {}

  /// Error of the speed [rad/s] that a second may bring.
  template <class V>
  [[gnu::always_inline]] V allowed(const V& speed) const {
    return absolute_ + relative_ * abs(speed);
  }
  /// What a term of a step of h [s] may add to it, per h.
  template <class V>
  [[gnu::always_inline]] V allowed(const V& speed, double h) const {
    return h > 1.0 ? allowed(speed) * (1.0 / h) : allowed(speed);
  }
  template <class Width>
  [[gnu::always_inline]] Lanes<Width> allowed(const Lanes<Width>& speed, const Lanes<Width>& h) const {
    return select(h > 1.0, allowed(speed) * (1.0 / h), allowed(speed));
  }
  /// The same for a quantity of which the terms of its series add up to this size.
  double relative() const { return relative_; }
  /// The order with the least work where the step is free: it grows with the digits that are asked for, and is never
  /// low, for near a root the guards have to be exact to rounding whatever the tolerance.
  int order() const { return order_; }

  /// What rounding leaves unknown of a sum of terms over a step of h.
  static double rounding_of(Polynomial c, double h) {
    const double square = h * h;
    Pair size{0.0, 0.0}, power{1.0, h};
    std::size_t k = 0;
    for (; k + 1 < c.size(); k += 2, power *= square) {
      const Pair term = pair_at(&c[k]);
      size += (term < 0.0 ? -term : term) * power;
    }
    if (k < c.size()) size[0] += std::abs(c[k]) * power[0];
    return 4.0 * std::numeric_limits<double>::epsilon() * (size[0] + size[1]);
  }

  /// Whether the last terms of speed, states of effects and guards are negligible over a step of h.
  template <class Expansion>
  bool suffices(Expansion& e, double h) const {
    if (e.order < least_order) return false;
    const Powers powers = powers_of(h, e.order);
    if (!fades(e.omega, e.order, h, powers)) return false;
    for (const Coefficients& state : e.states)
      if (!fades(state, e.order, h, powers)) return false;
    for (std::size_t g = 0; g < e.guards.size(); ++g)
      if (guard_step(e, static_cast<int>(g), h, powers) < h) return false;
    return true;
  }

  /// The step within h over which the series suffices.
  template <class Expansion>
  double step(Expansion& e, double h) const {
    double log2_step = log2_of_step(e.omega, e.order, rough_log2(h));
    for (const Coefficients& state : e.states) log2_step = log2_of_step(state, e.order, log2_step);
    h = std::min(h, rough_exp2(log2_step));
    double shortest = h;
    const Powers powers = powers_of(h, e.order);
    for (std::size_t g = 0; g < e.guards.size(); ++g)
      shortest = std::min(shortest, guard_step(e, static_cast<int>(g), h, powers));
    return shortest;
  }

 private:
  static constexpr double coarsest = 1e-13;     ///< tolerance from which on a looser one does not lower the order ...
  static constexpr double loosest_step = 1e-8;  ///< ... nor lengthen a free step, which a guard would halve again

  /// Powers of a step, of the terms in the window.
  using Powers = std::array<double, window>;
  static Powers powers_of(double h, int order) {
    Powers powers;
    double power = times_power(h, h, order - window);
    for (double& p : powers) p = std::exchange(power, power * h);
    return powers;
  }

  /// Whether the last terms of one of them are negligible. powers: of h.
  [[gnu::always_inline]] bool fades(const Coefficients& c, int order, double h, const Powers& powers) const {
    const double most = allowed(c[0], h) * h;
    for (int k = 0; k < window; ++k)
      if (!(std::abs(c[order - window + 1 + k]) * powers[k] <= most)) return false;
    return true;
  }
  /// Base-2 logarithm of the step within one, given by the same, over which they are.
  [[gnu::always_inline]] double log2_of_step(const Coefficients& c, int order, double log2_step) const {
    const double allowed_log2 = rough_log2(std::min(1.0, loosest_step / relative_) * allowed(c[0]));
    for (int k = order - window + 1; k <= order; ++k) {
      // Terms fall by at least 2^4 each. That lets earlier ones count where the last happen to vanish.
      const double size = rough_log2(std::abs(c[k]));
      const double room = allowed_log2 + 4.0 * (order - k) - size;
      // beyond a second the error is that of a step
      log2_step = std::min(log2_step, room * reciprocal[room > 0.0 ? k : k - 1]);
    }
    return log2_step;
  }

  /// The longest of the steps h, h/2, h/4 ... over which a guard certainly has no root behind its start, or else that
  /// over which it is exact to rounding: an error near a root, where the guard may only touch zero, would show as two
  /// events. What is left out is taken to be no more than the last terms together. powers: of h.
  template <class Expansion>
  static double guard_step(Expansion& e, int g, double h, Powers powers) {
    Polynomial c = e.guard(g);
    const double* last = &c[c.size() - window];
    // One that starts as a power of the time has the roots of the rest, and the terms that count are those behind its
    // first. Behind the coefficients that are told from rounding this is no start.
    constexpr std::size_t told = 4;
    std::size_t first = 1;
    while (first <= told && c[0] == 0.0 && c[first] == 0.0) ++first;
    if (first <= told) c = c.subspan(first - 1);
    const int lowered = e.order + 1 - static_cast<int>(c.size());
    const int uncounted = lowered > 0 ? std::max(0, window + 2 - static_cast<int>(c.size())) : 0;
    for (double s = h;; powers = powers_of(s *= 0.5, e.order)) {
      double left_out = 0.0, most = 0.0, scale = 1.0;
      for (int n = 0; n < lowered; ++n) scale *= s;
      for (int k = uncounted; k < window; ++k) {
        const double term = std::abs(last[k]) * powers[k];
        left_out += term;
        // of the last two each has to be below rounding, of those before them as much less as terms fall
        most = std::max(most, term * share_of_last[k]);
      }
      const double loss = left_out + scale * possible_loss(c, s), gain = scale * c[1] * s;
      e.positive[g] = c[0] + std::min(c[1], 0.0) * s - loss > share_left * c[0];
      if (e.positive[g] || gain - loss > share_left * gain) return s;
      const double excess = most / (scale * rounding_of(c, s));
      if (!(excess > 1.0)) return s;
      // terms that grow beyond all rounding on a step far too long tell nothing of a short one
      const double exact = s * rough_exp2(-rough_log2(excess) / (e.order - lowered - 1));
      if (exact >= 0.5 * s) return exact;
    }
  }
  static constexpr std::array<double, window> share_of_last{0x1p-20, 0x1p-16, 0x1p-12, 0x1p-8, 1.0, 1.0};

  double absolute_;  ///< of the speed [rad/s]
  double relative_;
  int order_;
};

}  // namespace wormdrive
