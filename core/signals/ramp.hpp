#pragma once
#include <limits>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/pieces/piece.hpp"

namespace wormdrive {

/// rate (t - start) from start to end, 0 before and held after.
struct Ramp {
  static constexpr std::string_view kind = "ramp";
  static constexpr std::string_view meaning = "rate (t - start) from start to end, 0 before and held after";
  double rate{};
  double start{0.0};
  double end{std::numeric_limits<double>::infinity()};

  static constexpr auto fields() {
    using P = Ramp;
    return std::tuple{
        Field{&P::rate, "rate", unit::newton_metre_per_second, bounds::any, "slope"},
        Field{&P::start, "start", unit::second, bounds::any, "time at which it leaves 0", Presence::optional},
        Field{&P::end, "end", unit::second, bounds::any, "time from which it is held", Presence::optional}};
  }
  void add_to(Piece& piece, double t) const {
    if (t < start) return;
    if (t >= end) {
      if (end > start) piece.add(rate * (end - start));
      return;
    }
    piece.add(rate * (t - start));
    piece.slope += rate;
  }
  double next_knot(double t) const {
    if (t < start) return start;
    return t < end ? end : std::numeric_limits<double>::infinity();
  }
};

}  // namespace wormdrive
