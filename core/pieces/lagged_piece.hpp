#pragma once
#include <cmath>
#include <utility>

#include "core/numbers/jet.hpp"
#include "core/numbers/portable.hpp"
#include "core/pieces/piece.hpp"

namespace wormdrive {

/// What a first-order lag, lag y' = u - y, makes of a piece u of a signal, in closed form: the response that stays,
/// and a rest of what was before that decays.
template <class T>
class LaggedPiece {
 public:
  LaggedPiece() = default;
  /// constant: that of the piece, with its derivatives; lag [s]; y(begin) = y_begin.
  LaggedPiece(Piece u, const T& constant, const T& lag, const T& begin, const T& y_begin)
      : u_(std::move(u)), constant_(constant), lag_(lag), begin_(begin), excess_(y_begin - staying(begin)) {}

  template <class S>
  S operator()(const S& t) const {
    using portable::exp;
    return staying(t) + excess_ * exp((begin_ - t) / lag_);
  }

  /// The part of it that decays.
  double decaying(double t) const { return value_of(excess_) * portable::exp((value_of(begin_) - t) / value_of(lag_)); }
  /// From when on what decays is below rounding [s].
  double settled() const { return value_of(begin_) + 40.0 * value_of(lag_); }

 private:
  template <class S>
  S staying(const S& t) const {
    using portable::cos, portable::sin;
    S y = constant_ + u_.slope * (t - u_.start - lag_);
    for (const Cosine& c : u_.cosines) {
      const T turn = c.omega * lag_;
      const S x = c.omega * t + c.phase;
      y += c.amplitude / (1.0 + turn * turn) * (cos(x) + turn * sin(x));
    }
    return y;
  }

  Piece u_{};
  T constant_{}, lag_{1.0}, begin_{}, excess_{};
};

}  // namespace wormdrive
