#pragma once
#include <tuple>

#include "core/field.hpp"

namespace wormdrive {

/// Where a run starts.
template <class T>
struct InitialState {
  T theta_g{0.0};  ///< [rad]
  T omega_g{0.0};  ///< [rad/s]

  static constexpr auto fields() {
    using P = InitialState;
    return std::tuple{
        Field{&P::theta_g, "gear_angle", unit::radian, bounds::any, "gear angle at the start", Presence::optional},
        Field{&P::omega_g, "gear_speed", unit::radian_per_second, bounds::any, "gear speed at the start",
              Presence::optional}};
  }
};

}  // namespace wormdrive
