#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "core/rigid_drive.hpp"

namespace wormdrive {

/// What counts as one of a state's derivatives by each parameter where the state itself counts in units of one: one
/// over the parameter, or what it does to the acceleration within a second where that is more.
template <class Drive>
class DerivativeScales {
  using T = typename Drive::State::Scalar;

 public:
  explicit DerivativeScales(std::span<const Parameter> by) {
    for (std::size_t k = 0; k < by.size(); ++k)
      if (by[k].value != 0.0) scale_[k] = 1.0 / std::abs(by[k].value);
  }
  /// Looks at where the run is.
  void see(const Drive& drive, const typename Drive::Instant& now) {
    auto values = now.x;
    for (T& x : values) x = T(x.a);
    const T effect = drive.derivative(now.t, values, now.mode)[1];
    for (int k = 0; k < T::DIMENSION; ++k)
      scale_[k] = std::max({scale_[k], std::abs(effect.v[k]), std::abs(now.x[0].v[k]), std::abs(now.x[1].v[k])});
  }
  /// 1 where nothing is known.
  double operator[](int k) const { return scale_[k] > 0.0 ? scale_[k] : 1.0; }

 private:
  std::array<double, T::DIMENSION> scale_{};
};

}  // namespace wormdrive
