#pragma once
#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace wormdrive {

/// A drive whose controller's torques are known: at any time of the past it holds what was held then. An audit that
/// comes back to a segment thus finds the inputs of the run.
template <class Drive>
class Replay : public Drive {
 public:
  struct Held {
    double t;                    ///< from when on [s]
    double torque, disturbance;  ///< of the motor, and beside it [N m]
  };
  Replay(const Drive& drive, std::vector<Held> held) : Drive(drive), held_(std::move(held)) {}

  void enter(double t) {
    if (t < entered_) {
      Drive::rewind();
      entered_ = -std::numeric_limits<double>::infinity();
      issued_ = 0;
    }
    // a torque that lags or is delayed hangs on everything that came before it
    for (double next = next_knot(entered_); next < t; next = next_knot(next)) enter_piece(next);
    enter_piece(t);
  }
  double next_knot(double t) const {
    const auto next = after(t);
    return std::min(Drive::next_knot(t), next == held_.end() ? std::numeric_limits<double>::infinity() : next->t);
  }

 private:
  void enter_piece(double t) {
    Drive::enter(t);
    for (; issued_ < held_.size() && held_[issued_].t <= t; ++issued_) {
      Drive::disturb(held_[issued_].disturbance);
      Drive::command(held_[issued_].t, held_[issued_].torque);
    }
    entered_ = t;
  }
  auto after(double t) const {
    return std::upper_bound(held_.begin(), held_.end(), t, [](double a, const Held& h) { return a < h.t; });
  }
  std::vector<Held> held_;
  std::size_t issued_ = 0;
  double entered_ = std::numeric_limits<double>::infinity();  ///< [s]; the drive has been through a run
};

}  // namespace wormdrive
