#pragma once

namespace wormdrive {

/// The worm angle as a function of the gear angle, divided by the ratio i, with its first two derivatives.
template <class S>
struct Transmission {
  S angle;      ///< theta_w / i [rad]
  S slope;      ///< k = d(theta_w / i)/d(theta_g)
  S curvature;  ///< k' = dk/d(theta_g) [1/rad]
};

}  // namespace wormdrive
