#pragma once
#include <limits>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/pieces/piece.hpp"

namespace wormdrive {

/// 0 before a time, a torque from then on.
struct Step {
  static constexpr std::string_view kind = "step";
  static constexpr std::string_view meaning = "0 before a time, a torque from then on";
  double torque{};
  double time{};

  static constexpr auto fields() {
    using P = Step;
    return std::tuple{Field{&P::torque, "torque", unit::newton_metre, bounds::any, "torque after the step"},
                      Field{&P::time, "time", unit::second, bounds::any, "time of the step"}};
  }
  void add_to(Piece& piece, double t) const {
    if (t >= time) piece.add(torque);
  }
  double next_knot(double t) const { return t < time ? time : std::numeric_limits<double>::infinity(); }
};

}  // namespace wormdrive
