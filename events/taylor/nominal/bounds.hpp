#pragma once
#include <array>
#include <cstddef>

#include "events/taylor/polynomial.hpp"

namespace wormdrive {

/// How far a series must go for a motion theta'' = f(t) + gamma cos(theta + offset) - drag theta' none of whose rates
/// exceeds sigma [1/s]: theta'^2, theta'', drag^2, the frequencies and the cube root of the slope of f.
///
/// Then |theta^(k)| <= m_k sigma^k and |d^k cos(theta + offset)/dt^k| <= mu_k sigma^k, where m and mu are the
/// derivatives of y and e^y at 0 for y'' = e^y + y', y' = y'' = 1 there: e^y has every derivative of the cosine
/// without its signs. The first term left out bounds the remainder (Lagrange).
class MotionBounds {
 public:
  constexpr MotionBounds() {
    constexpr std::size_t last = highest_order + 1;
    std::array<double, last + 2> m{}, mu{}, binomial{1.0};  // binomial: row k - 1 of Pascal's triangle
    m[1] = m[2] = mu[0] = 1.0;
    double factorial = 1.0;
    for (std::size_t k = 1; k <= last; ++k) {
      for (std::size_t j = 1; j <= k; ++j) mu[k] += binomial[j - 1] * m[j] * mu[k - j];
      for (std::size_t j = k; j >= 1; --j) binomial[j] += binomial[j - 1];
      if (k + 2 < m.size()) m[k + 2] = mu[k] + m[k + 1];
      factorial *= static_cast<double>(k);
      remainder_[k] = (mu[k - 1] > m[k] ? mu[k - 1] : m[k]) / factorial;
    }
  }

  /// Error of the speed per second that a series of the angle up to theta^(n) makes over a step of reach/sigma, divided
  /// by (gamma + waves + drag sigma) reach^(n-1), where waves is the amplitude of what oscillates in f.
  constexpr double remainder(int n) const { return remainder_[static_cast<std::size_t>(n)]; }

 private:
  std::array<double, highest_order + 2> remainder_{};
};

inline constexpr MotionBounds motion_bounds{};

}  // namespace wormdrive
