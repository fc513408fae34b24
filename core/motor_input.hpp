#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/limited_piece.hpp"
#include "core/signal.hpp"

namespace wormdrive {

/// The torque that a motor is told to give: a signal over time and what a controller holds on top of it, cut at a
/// limit, and frozen to the smooth piece that holds now.
class MotorInput {
 public:
  MotorInput(Signal signal, double limit) : signal_(std::move(signal)), limit_(limit) {}

  /// Freezes the torque to the piece that holds from t on.
  void enter(double t) {
    piece_ = signal_.piece(t);
    signal_constant_ = piece_.constant;
    command(t, command_);
  }
  /// Holds a torque [N m] from t on, in addition to the signal.
  void command(double t, double torque) {
    command_ = torque;
    if (std::isinf(limit_)) {
      piece_.constant = signal_constant_ + torque;
      return;
    }
    Piece unlimited = signal_.piece(t);
    unlimited.constant += torque;
    LimitedPiece cut = limited(unlimited, limit_, t);
    piece_ = std::move(cut.piece);
    limit_knot_ = cut.until;
  }

  /// The smooth piece that holds now [N m].
  const Piece& piece() const { return piece_; }
  /// First time after t at which the torque jumps or bends.
  double next_knot(double t) const { return std::min(signal_.next_knot(t), limit_knot_); }

 private:
  Signal signal_;
  Piece piece_{};
  double limit_;  ///< [N m], infinity without a limit
  double signal_constant_ = 0.0, command_ = 0.0;
  double limit_knot_ = std::numeric_limits<double>::infinity();  ///< when the limit begins or ends to cut [s]
};

}  // namespace wormdrive
