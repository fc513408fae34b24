#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <utility>

#include "core/numbers/jet.hpp"
#include "core/numbers/queue.hpp"
#include "core/pieces/lagged_piece.hpp"
#include "core/pieces/limited_piece.hpp"
#include "core/signal.hpp"

namespace wormdrive {

/// The torque that a motor gives on a command: a signal over time and what a controller holds on top of it, cut at a
/// limit, delayed and lagged, and frozen to the smooth piece that holds now. Before the start the command is 0.
template <class T>
class MotorInput {
 public:
  /// limit [N m], infinity without one; delay [s]; time constant of the lag [s], 0 without one.
  MotorInput(Signal signal, const T& limit, const T& delay, const T& lag)
      : signal_(std::move(signal)),
        limit_(limit),
        delay_(delay),
        late_(value_of(delay)),
        lag_(lag),
        plain_(std::is_same_v<T, double> && late_ <= 0.0 && !lags()),
        direct_(plain_ && std::isinf(value_of(limit))) {}

  /// Forgets what was commanded, for a new run from its start.
  void rewind() {
    on_the_way_.clear();
    held_ = knot_ = 0.0;
    started_ = false;
  }
  /// Freezes the torque to the piece that holds from t on.
  void enter(double t) {
    arrival_ = T(t);
    while (!on_the_way_.empty() && on_the_way_.front().arrival <= t) {
      held_ = on_the_way_.front().torque;
      on_the_way_.pop();
      arrival_ = moving(t);
    }
    // A knot of the command arrives late_ after it; rounding must not make it a moment too early to be seen.
    const bool arrives = knot_ + late_ <= t;
    const double commanded = arrives ? std::max(t - late_, knot_) : t - late_;
    if (arrives) arrival_ = moving(t);
    const Piece signal = commanded < 0.0 ? Piece{} : signal_.piece(commanded);
    knot_ = commanded < 0.0 ? 0.0 : signal_.next_knot(commanded);
    signal_constant_ = signal.constant;
    freeze(signal, commanded);
  }
  /// Commands a torque [N m] from t on, in addition to the signal; whether the next knot may be another one now.
  [[gnu::always_inline]] bool command(double t, double torque) {
    if (!direct_) return command_indirect(t, torque);
    held_ = torque;
    arrival_ = T(t);
    piece_.constant = signal_constant_ + torque;
    return false;
  }

  /// The torque at a time of the piece [N m].
  template <class S>
  S operator()(const S& t) const {
    const S then = t - delay_;
    if (lags()) return lagged_(then);
    return side_ == 0 ? piece_(then) : S(cut_off());
  }
  bool is_constant() const { return !lags() && piece_.is_constant(); }
  /// Whether the torque follows the command with a lag, its time constant [s], and what is left of the torque before at
  /// a time [N m].
  bool lags() const { return lag_ > T(0); }
  double lag() const { return value_of(lag_); }
  double decaying(double t) const { return lagged_.decaying(t - late_); }
  /// Lets a torque that lags, or one that is commanded with a delay and has arrived, have this value [N m] now.
  void resume(double t, double torque) {
    if (!lags()) {
      on_the_way_.clear();
      held_ = torque;
      return freeze(Piece{}, t);
    }
    lagged_ = {Piece{}, T(0), lag_, T(t), T(torque)};
    started_ = true;
  }
  /// When what holds now has arrived [s]: a knot of the command moves with the delay, one of the load does not.
  const T& arrival() const { return arrival_; }
  /// The smooth piece of the command that the motor has now; its time is delayed.
  const Piece& piece() const { return piece_; }
  /// Largest magnitude of the command [N m], infinity without a limit.
  double limit() const { return value_of(limit_); }
  /// First time after t at which the torque jumps or bends.
  double next_knot(double t) const {
    const double arrival = on_the_way_.empty() ? never : on_the_way_.front().arrival;
    const double signal = late_ > 0.0 ? knot_ + late_ : signal_.next_knot(t);
    return std::min({signal, limit_knot_ + late_, arrival});
  }
  /// Highest angular frequency of the torque, or rate of its decay, from t on [rad/s].
  double fastest(double t) const {
    const bool decays = lags() && t - late_ < lagged_.settled();
    return decays ? std::max(piece_.fastest(), 1.0 / value_of(lag_)) : piece_.fastest();
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();
  struct Command {
    double arrival, torque;
  };

  /// The same through a limit, a delay or a lag.
  [[gnu::noinline]] bool command_indirect(double t, double torque) {
    arrival_ = T(t);
    if (plain_ && signal_.terms.empty()) {  // what is held for good is cut once
      held_ = torque;
      side_ = 0;
      piece_.constant = std::clamp(signal_constant_ + torque, -limit(), limit());
      return false;
    }
    if (late_ > 0.0) {
      on_the_way_.push({t + late_, torque});
      return true;
    }
    held_ = torque;
    arrival_ = moving(t);
    if (std::isinf(value_of(limit_)) && !lags())
      piece_.constant = signal_constant_ + torque;
    else
      freeze(signal_.piece(t), t);
    return true;
  }

  /// A time at which something commanded arrives, with its derivative by the delay.
  T moving(double t) const { return T(t) + (delay_ - late_); }
  /// What the limit leaves of the command now [N m].
  T cut_off() const { return T(side_) * limit_; }

  /// Takes up the piece of the signal that was commanded then.
  void freeze(Piece piece, double commanded) {
    piece.add(held_);
    limit_knot_ = never;
    if (!std::isinf(value_of(limit_))) {
      LimitedPiece cut = limited(piece, value_of(limit_), commanded);
      piece = std::move(cut.piece);
      side_ = cut.side;
      limit_knot_ = cut.until;
    }
    if (lags()) {
      const T then(commanded), before = started_ ? lagged_(then) : T(0);
      lagged_ = {piece, side_ == 0 ? T(piece.constant) : cut_off(), lag_, then, before};
      started_ = true;
    }
    piece_ = std::move(piece);
  }

  Signal signal_;
  Piece piece_{};
  T limit_;
  T delay_;
  double late_;  ///< the delay's value [s]
  T lag_;
  bool plain_;    ///< nothing carries a derivative, and what is commanded arrives at once ...
  bool direct_;   ///< ... and uncut: what is commanded is what the motor gives
  int side_ = 0;  ///< of the limit that holds now, 0 for none
  T arrival_{};
  LaggedPiece<T> lagged_{};
  bool started_ = false;
  Queue<Command> on_the_way_{};                ///< what a controller has commanded and has not arrived
  double signal_constant_ = 0.0, held_ = 0.0;  ///< of the signal, and on top of it [N m]
  double knot_ = 0.0;                          ///< the next knot of the signal [s], as commanded
  double limit_knot_ = never;                  ///< when the limit begins or ends to cut [s], as commanded
};

}  // namespace wormdrive
