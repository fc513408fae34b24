#pragma once
#include "core/mode.hpp"

namespace wormdrive {

/// How fast bristles bend, z' = v - |v| h/g = v (1 - sgn(v) h/g), at a sliding speed v; loaded = h/g: what they carry,
/// as a share of what they slide under. |v| is by the sign of the motion, smooth where an integrator looks beyond a
/// reversal.
template <class T, class S>
S bending_of_bristles(const S& speed, Motion motion, const S& loaded) {
  return speed * (S(T(1)) - T(sign(motion)) * loaded);
}

}  // namespace wormdrive
