#pragma once

#include "core/mode.hpp"

namespace wormdrive {

/// What equations may depend on: time [s], gear angle [rad], gear speed and worm speed [rad/s], worm angle [rad].
template <class S>
struct Moment {
  S t;
  S theta_g;
  S omega_g;
  S omega_w;
  S theta_w{};
};

}  // namespace wormdrive
