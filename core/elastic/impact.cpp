#include "core/elastic/impact.hpp"

#include <algorithm>

#include <boost/math/special_functions/log1p.hpp>

#include "core/numbers/crossing.hpp"

namespace wormdrive {

double restitution(const HuntCrossley<double>& law, double, double speed) {
  const double x = law.damping * speed;
  if (x < 1e-8) return 1.0 - 2.0 / 3.0 * x;  // to rounding
  const double before = boost::math::log1pmx(x);
  const auto more_than_before = [before](double y) { return before - boost::math::log1pmx(-y); };
  // Teeth part more slowly than they met, and more slowly than 1/c: at that speed the law would no longer push.
  const double most = std::min(x, std::nextafter(1.0, 0.0)), excess = more_than_before(most);
  return (excess > 0.0 ? root_between(FunctionView<double>(more_than_before), 0.0, before, most, excess) : most) / x;
}

double restitution(const LimitedDamper<double>& law, double mass, double) {
  const double zeta = 0.5 * law.damping / (std::sqrt(law.stiffness) * std::sqrt(mass));
  if (zeta <= 1.0) {
    const double delta = std::sqrt((1.0 - zeta) * (1.0 + zeta));
    const double t = delta > 0.0 ? std::atan2(4.0 * zeta * delta, 4.0 * zeta * zeta - 1.0) / delta : 4.0 / 3.0;
    return std::exp(-zeta * t);
  }
  const double share = std::sqrt((1.0 - 1.0 / zeta) * (1.0 + 1.0 / zeta));  // of zeta: what the fast motion has more
  return std::exp(-std::asinh(4.0 * zeta * share / std::hypot(1.0 / zeta, std::sqrt(8.0))) / share);
}

}  // namespace wormdrive
