#pragma once
#include "core/moment.hpp"

namespace wormdrive {

/// A load whose functions of time together come to a given torque [N m], whatever the time.
template <class Load, class S>
struct GivenLoad {
  const Load& all;
  S over_time;

  double inertia() const { return all.inertia(); }
  S torque(const Moment<S>& at, Motion motion) const {
    if constexpr (requires { all.torque(over_time, at, motion); })
      return all.torque(over_time, at, motion);
    else if constexpr (requires { all.over_time(); })
      return over_time;
    else if constexpr (requires { all.torque(at, motion); })
      return all.torque(at, motion);
    else
      return all.torque(at);
  }
};

}  // namespace wormdrive
