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
    double t;       ///< from when on [s]
    double torque;  ///< [N m]
  };
  Replay(const Drive& drive, std::vector<Held> held) : Drive(drive), held_(std::move(held)) {}

  void enter(double t) {
    Drive::enter(t);
    const auto next = after(t);
    if (next != held_.begin()) Drive::command(t, std::prev(next)->torque);
  }
  double next_knot(double t) const {
    const auto next = after(t);
    return std::min(Drive::next_knot(t), next == held_.end() ? std::numeric_limits<double>::infinity() : next->t);
  }

 private:
  auto after(double t) const {
    return std::upper_bound(held_.begin(), held_.end(), t, [](double a, const Held& h) { return a < h.t; });
  }
  std::vector<Held> held_;
};

}  // namespace wormdrive
