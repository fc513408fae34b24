#pragma once
#include <limits>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/pieces/piece.hpp"

namespace wormdrive {

/// The same torque at all times.
struct Constant {
  static constexpr std::string_view kind = "constant";
  static constexpr std::string_view meaning = "the same torque at all times";
  double torque{};

  static constexpr auto fields() {
    return std::tuple{Field{&Constant::torque, "torque", unit::newton_metre, bounds::any, "torque"}};
  }
  void add_to(Piece& piece, double) const { piece.add(torque); }
  double next_knot(double) const { return std::numeric_limits<double>::infinity(); }
};

}  // namespace wormdrive
