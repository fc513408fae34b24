#pragma once
#include "core/moment.hpp"
#include "core/signal.hpp"

namespace wormdrive {

/// A load torque that depends on time alone, constant included.
struct TimedLoad {
  Signal signal;
  Piece piece{};

  double inertia() const { return 0.0; }
  void enter(double t) { piece = signal.piece(t); }
  double next_knot(double t) const { return signal.next_knot(t); }
  double fastest() const { return piece.fastest(); }
  double ripple() const { return 0.0; }
  const TimedLoad* over_time() const { return this; }

  /// Load torque tau_l [N m], positive in the direction of positive theta_g.
  template <class S>
  S torque(const Moment<S>& at) const {
    return piece(at.t);
  }
};

}  // namespace wormdrive
