#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/numbers/crossing.hpp"
#include "core/numbers/rounded.hpp"
#include "core/pieces/piece.hpp"

namespace wormdrive {

/// A piece cut at +-limit: what holds from a time on, and until when it does.
struct LimitedPiece {
  Piece piece;
  int side;      ///< of the limit that holds, +1 or -1; 0 where the piece is not cut
  double until;  ///< [s]; at the latest one period on, where the piece is simply looked at again
};

/// Cuts a piece at +-limit from t on.
inline LimitedPiece limited(const Piece& raw, double limit, double t) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const auto ahead = [&](double at) { return raw(Series<double, 1>::variable(at)); };
  const Series<double, 1> now = ahead(t);
  const double side = now[0] < 0.0 ? -1.0 : 1.0;
  // Entered where the piece reaches the limit, rounding leaves it on either side: its derivatives decide.
  using Exact = Series<Rounded, 3>;
  const bool cut = sign_just_after(side * raw(Exact::variable(t)) - Exact(limit), time_resolution(t)) > 0;
  // Positive while this state of affairs lasts.
  const auto lasts = [&](double sign) {
    return [&ahead, sign, limit, cut](double at) {
      const Series<double, 1> x = ahead(at);
      return cut ? Series<double, 1>(-limit) + sign * x : Series<double, 1>(limit) - sign * x;
    };
  };
  double until = never;
  if (const double omega = raw.fastest(); omega > 0.0) {
    const double period = 2.0 * std::numbers::pi / omega, step = 0.05 / omega;
    until = t + period;
    for (const double sign : {-1.0, 1.0}) {
      if (cut && sign != side) continue;
      const auto guard = lasts(sign);
      for (double a = t; a < until;) {
        const double b = std::min(until, a + step);
        const auto crossing = falling_crossing(guard, a, guard(a), b, guard(b));
        if (crossing && *crossing > t) {
          until = *crossing;
          break;
        }
        a = b;
      }
    }
  } else if (raw.slope != 0.0) {
    const double target = cut ? side * limit : std::copysign(limit, raw.slope);
    const double crossing = raw.start + (target - raw.constant) / raw.slope;
    if (crossing > t) until = crossing;
  }
  if (!cut) return {raw, 0, until};
  Piece held;
  held.start = t;
  held.constant = side * limit;
  return {held, side < 0.0 ? -1 : 1, until};
}

}  // namespace wormdrive
