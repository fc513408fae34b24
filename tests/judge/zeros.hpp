#pragma once
#include <array>
#include <cstddef>
#include <vector>

#include "judge/real.hpp"

namespace judge {

template <class Real>
Real value(const std::vector<Real>& c, Real s) {
  Real sum = 0;
  for (std::size_t k = c.size(); k-- > 0;) sum = sum * s + c[k];
  return sum;
}
template <class Real>
std::vector<Real> derivative(const std::vector<Real>& c) {
  std::vector<Real> d;
  for (std::size_t k = 1; k < c.size(); ++k) d.push_back(Real(static_cast<double>(k)) * c[k]);
  return d;
}

/// The sum of the sizes of a polynomial's terms at s.
template <class Real>
Real bound(const std::vector<Real>& c, Real s) {
  Real sum = 0;
  for (std::size_t k = c.size(); k-- > 0;) sum = sum * s + abs(c[k]);
  return sum;
}

/// The root between a and b, where a monotone polynomial has values of different signs: Newton's method in a bracket.
template <class Real>
Real bracketed(const std::vector<Real>& c, const std::vector<Real>& slope, Real a, Real b) {
  const bool rises = value(c, b) > 0;
  Real x = (a + b) / 2, before = b - a;
  for (int k = 0; k < 300; ++k) {
    const Real f = value(c, x);
    if (f == 0) return x;
    ((f > 0) == rises ? b : a) = x;
    const Real d = value(slope, x), newton = d != 0 ? x - f / d : a;
    const bool use = newton > a && newton < b && 2 * abs(newton - x) < before;
    const Real next = use ? newton : (a + b) / 2;
    before = abs(next - x);
    if (next == x || next <= a || next >= b) return next;
    x = next;
  }
  return x;
}

/// All roots of a polynomial in [0, h], by those of its derivatives: between two of them it is monotone. In turns, if
/// given, where it turns.
template <class Real>
std::vector<Real> zeros(const std::vector<Real>& c, Real h, std::vector<Real>* turns = nullptr) {
  if (c.size() < 2) return {};
  if (2 * abs(c[0]) > bound(c, h)) return {};
  const std::vector<Real> slope = derivative(c);
  const std::vector<Real> monotone = zeros(slope, h);
  if (turns) *turns = monotone;
  std::vector<Real> found;
  Real a = 0, at_a = c[0];
  if (at_a == 0) found.push_back(a);
  for (std::size_t k = 0; k <= monotone.size(); ++k) {
    const Real b = k < monotone.size() ? monotone[k] : h;
    if (b <= a) continue;
    const Real at_b = value(c, b);
    if (at_b == 0)
      found.push_back(b);
    else if (at_a != 0 && (at_a > 0) != (at_b > 0))
      found.push_back(bracketed(c, slope, a, b));
    a = b;
    at_a = at_b;
  }
  return found;
}

/// A polynomial without leading coefficients that are rounding of the others over [0, h].
template <class Real>
std::vector<Real> without_rounding(std::vector<Real> c, Real h) {
  const Real least = Precision<Real>::rounding * bound(c, h);
  Real power = 1;
  for (Real& term : c) {
    if (abs(term) * power > least) break;
    term = 0;
    power *= h;
  }
  return c;
}
/// Its sign just after 0.
template <class Real>
int lead(const std::vector<Real>& c, Real h) {
  for (const Real& term : without_rounding(c, h))
    if (term != 0) return term > 0 ? 1 : -1;
  return 0;
}

/// The sign of a polynomial from a time on.
template <class Real>
struct Span {
  Real from;
  int sign;
};
template <class Real>
std::vector<Span<Real>> signs(const std::vector<Real>& given, Real h) {
  const std::vector<Real> c = without_rounding(given, h);
  std::vector<Span<Real>> spans{{Real(0), lead(c, h)}};
  const std::vector<Real> roots = zeros(c, h);
  for (std::size_t k = 0; k < roots.size(); ++k) {
    if (roots[k] <= 0 || roots[k] >= h) continue;
    const Real next = k + 1 < roots.size() ? roots[k + 1] : h, f = value(c, Real((roots[k] + next) / 2));
    const int sign = f > 0 ? 1 : f < 0 ? -1 : 0;
    if (sign != 0 && sign != spans.back().sign) spans.push_back({roots[k], sign});
  }
  return spans;
}

}  // namespace judge
