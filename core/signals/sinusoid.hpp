#pragma once
#include <limits>
#include <numbers>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/pieces/piece.hpp"

namespace wormdrive {

/// amplitude cos(2 pi frequency t + phase).
struct Sinusoid {
  static constexpr std::string_view kind = "sinusoid";
  static constexpr std::string_view meaning = "amplitude cos(2 pi frequency t + phase)";
  double amplitude{};
  double frequency{};
  double phase{0.0};

  static constexpr auto fields() {
    using P = Sinusoid;
    return std::tuple{Field{&P::amplitude, "amplitude", unit::newton_metre, bounds::any, "amplitude of the cosine"},
                      Field{&P::frequency, "frequency", unit::hertz, bounds::positive, "frequency"},
                      Field{&P::phase, "phase", unit::degrees, bounds::any, "phase at t = 0", Presence::optional}};
  }
  void add_to(Piece& piece, double) const {
    piece.cosines.push_back({amplitude, 2.0 * std::numbers::pi * frequency, phase});
  }
  double next_knot(double) const { return std::numeric_limits<double>::infinity(); }
};

}  // namespace wormdrive
