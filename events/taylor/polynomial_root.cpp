#include "events/taylor/polynomial_root.hpp"

#include <algorithm>
#include <cmath>

namespace wormdrive {
namespace {

constexpr double precision = 0x1p-53;
constexpr double instant = 1e-11;  // resolution of a guard that is interpolated [s]
constexpr int deepest = 40;        // halvings of a step, until what is left is below any resolution

/// Value and slope at s, and what the terms of the value add up to without their signs.
struct Sample {
  double value = 0.0, slope = 0.0, size = 0.0;

  /// By Horner's rule on the even and the odd powers; s >= 0.
  Sample(Polynomial c, double s) {
    const double square = s * s;
    Pair values{0.0, 0.0}, slopes{0.0, 0.0}, sizes{0.0, 0.0};  // slopes: against the square
    const auto take = [&](Pair next) {
      slopes = slopes * square + values;
      values = values * square + next;
      sizes = sizes * square + abs(next);
    };
    auto k = c.size();
    if (k % 2 == 1) take(Pair{c[--k], 0.0});
    for (; k > 0; k -= 2) take(pair_at(&c[k - 2]));
    value = values[0] + s * values[1];
    slope = values[1] + 2.0 * s * (slopes[0] + s * slopes[1]);
    size = sizes[0] + s * sizes[1];
  }
};

/// The same polynomial in the time since s = begin.
Coefficients shifted(Polynomial c, double begin) {
  Coefficients d;
  std::copy(c.begin(), c.end(), d.begin());
  for (std::size_t i = 0; i + 1 < c.size(); ++i)
    for (std::size_t k = c.size() - 1; k-- > i;) d[k] += begin * d[k + 1];
  return d;
}

Coefficients mirrored(Polynomial c) {
  Coefficients d;
  std::transform(c.begin(), c.end(), d.begin(), [](double x) { return -x; });
  return d;
}

/// Bounds of slope and bend of a polynomial on [0, h].
struct Shape {
  double slope_low, slope_high, bend_low = 0.0, bend_high = 0.0;

  Shape(Polynomial c, double h) : slope_low(c[1]), slope_high(c[1]) {
    double power = 1.0;  // h^(k-2)
    for (std::size_t k = 2; k < c.size(); ++k, power *= h) {
      const double n = static_cast<double>(k), rate = n * c[k] * power, bend = (n - 1.0) * rate;
      slope_low += std::min(rate, 0.0) * h;
      slope_high += std::max(rate, 0.0) * h;
      bend_low += k == 2 ? bend : std::min(bend, 0.0);
      bend_high += k == 2 ? bend : std::max(bend, 0.0);
    }
  }
};

/// Number of leading coefficients that vanish next to their successor within an instant: the polynomial has that many
/// roots at s = 0. All of them where nothing remains.
std::size_t start_roots(Polynomial c) {
  for (std::size_t k = 0; k < c.size(); ++k) {
    const double next = k + 1 < c.size() ? std::abs(c[k + 1]) * static_cast<double>(k + 1) * instant : 0.0;
    if (std::abs(c[k]) > next) return k;
  }
  return c.size();
}

}  // namespace

bool falls_through(Polynomial c, double s, double rounding, double resolution) {
  double slope = 0.0, bend = 0.0, value = 0.0, size = 0.0;  // bend: half the second derivative
  for (std::size_t k = c.size(); k-- > 0;) {
    bend = bend * s + slope;
    slope = slope * s + value;
    value = value * s + c[k];
    size = size * s + std::abs(c[k]);
  }
  const double blur = rounding + 64.0 * precision * size + std::abs(slope) * resolution;
  return slope < 0.0 && slope * slope > 4.0 * std::abs(bend) * blur;  // the minimum is slope^2/(4 bend) below zero
}

RootSearch::Fall RootSearch::fall_from_start(Polynomial guard, double h, std::size_t vanishing) {
  if (vanishing >= guard.size()) return {};
  const Polynomial rest = guard.subspan(vanishing);
  return rest[0] > 0.0 ? Fall{first_root(rest, h), true} : Fall{0.0, true};
}

RootSearch::Fall RootSearch::start_of_segment(Polynomial guard, double h) {
  const auto found = [](double begin, std::optional<double> s) {
    return Fall{s ? std::optional(begin + *s) : std::nullopt, true};
  };
  Coefficients later;
  double begin = 0.0;
  for (std::size_t rises = 0; rises <= guard.size() && begin < h; ++rises) {
    const std::size_t roots = start_roots(guard);
    if (roots == guard.size()) return {};
    const Polynomial rest = guard.subspan(roots);
    if (rest[0] > 0.0) return found(begin, first_root(rest, h - begin));
    if (guard[0] > 0.0) return found(begin, first_root(guard, h - begin));  // positive, but for an instant only
    const Coefficients below = mirrored(rest);
    const auto rise = first_root({below.data(), rest.size()}, h - begin);
    if (!rise) return {};
    later = shifted(guard, *rise);
    later[0] = 0.0;
    guard = {later.data(), guard.size()};
    begin += *rise;
  }
  return {};
}

std::optional<double> RootSearch::root_within(Polynomial c, double h, int depth) {
  if (c.size() < 2) return std::nullopt;
  const Shape shape(c, h);
  if (shape.slope_low >= 0.0) return std::nullopt;
  if (shape.slope_high <= 0.0 || shape.bend_high <= 0.0) return fall_within(c, h);  // lowest at the end, or at 0
  if (shape.bend_low >= 0.0 || depth == deepest) {
    const auto lowest = lowest_within(c, h);
    return fall_within(c, lowest ? *lowest : h);
  }
  const double half = 0.5 * h;
  if (!stays_positive(c, half))
    if (const auto root = root_within(c, half, depth + 1)) return root;
  const Coefficients second = shifted(c, half);
  if (second[0] <= 0.0) return half;  // to rounding
  if (stays_positive({second.data(), c.size()}, half)) return std::nullopt;
  const auto root = root_within({second.data(), c.size()}, half, depth + 1);
  return root ? std::optional(half + *root) : std::nullopt;
}

/// Where a polynomial is lowest that falls at 0 and is bent upwards; none if it falls to the end.
std::optional<double> RootSearch::lowest_within(Polynomial c, double h) {
  if (c[1] >= 0.0 || Sample(c, h).slope <= 0.0) return std::nullopt;
  Coefficients falling;
  for (std::size_t k = 1; k < c.size(); ++k) falling[k - 1] = -static_cast<double>(k) * c[k];
  return fall_within({falling.data(), c.size() - 1}, h);
}

/// The root of a polynomial that crosses zero at most once in [0, h], falling: Newton's method, kept in a bracket.
std::optional<double> RootSearch::fall_within(Polynomial c, double h) {
  ++evaluations_;
  const double end = value(c, h);
  if (end > 0.0) return std::nullopt;
  double above = 0.0, below = h, s = h * (c[0] / (c[0] - end));
  for (int iteration = 0; iteration < 200; ++iteration) {
    ++evaluations_;
    const Sample there(c, s);
    (there.value > 0.0 ? above : below) = s;
    const double newton = s - there.value / there.slope;
    if (std::abs(there.value) <= precision * there.size) return s;  // at a double root the slope is no guide any more
    if (std::abs(newton - s) <= precision * h || below - above <= precision * h)
      return std::clamp(newton, above, below);
    s = newton > above && newton < below ? newton : 0.5 * (above + below);
  }
  return below;
}

}  // namespace wormdrive
