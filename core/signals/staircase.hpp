#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/pieces/piece.hpp"

namespace wormdrive {

/// Equal steps at equal intervals: the k-th is taken at start + k interval, k = 0, 1, ...
struct Staircase {
  static constexpr std::string_view kind = "staircase";
  static constexpr std::string_view meaning = "equal steps at equal intervals, the first at start";
  double rise{};
  double interval{};
  double start{0.0};
  double steps{std::numeric_limits<double>::infinity()};

  static constexpr auto fields() {
    using P = Staircase;
    return std::tuple{
        Field{&P::rise, "rise", unit::newton_metre, bounds::any, "height of one step"},
        Field{&P::interval, "interval", unit::second, bounds::positive, "time between two steps"},
        Field{&P::start, "start", unit::second, bounds::any, "time of the first step", Presence::optional},
        Field{&P::steps, "steps", unit::none, bounds::not_negative, "number of steps, then held", Presence::optional}};
  }
  void add_to(Piece& piece, double t) const { piece.add(rise * taken(t)); }
  double next_knot(double t) const {
    const double k = taken(t);
    return k < steps ? start + k * interval : std::numeric_limits<double>::infinity();
  }

 private:
  /// Steps taken at time t; a step's own instant, rounded as next_knot rounds it, counts.
  double taken(double t) const {
    double k = std::max(0.0, std::floor((t - start) / interval));
    while (k > 0.0 && start + (k - 1.0) * interval > t) k -= 1.0;
    while (k < steps && start + k * interval <= t) k += 1.0;
    return std::min(k, steps);
  }
};

}  // namespace wormdrive
