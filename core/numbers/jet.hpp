#pragma once
#include <ceres/jet.h>

namespace wormdrive {

/// The value of a scalar without the derivatives that it may carry.
inline double value_of(double x) { return x; }
template <int N>
double value_of(const ceres::Jet<double, N>& x) {
  return x.a;
}

/// A sign times a parameter, which Jets know for their own scalar only.
template <int N>
ceres::Jet<double, N> operator*(int sign, const ceres::Jet<double, N>& x) {
  return static_cast<double>(sign) * x;
}

}  // namespace wormdrive
