#pragma once
#include <cmath>

#include "core/mesh.hpp"

namespace wormdrive::test {

/// C of a signed friction m [YehWu2009, eq. 9].
inline double torque_ratio(const MeshParameters<double>& p, double m) {
  return p.lw / p.lg * (std::cos(p.phi_n) * std::sin(p.lambda) - m * std::cos(p.lambda)) /
         (std::cos(p.phi_n) * std::cos(p.lambda) + m * std::sin(p.lambda));
}

}  // namespace wormdrive::test
