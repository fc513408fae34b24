#pragma once
// What the tests of records and break-in tables share: synthetic data by formulas of their own.
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace wormdrive::test {

/// The drive of Table 1 of the paper, its torque ratio by eq. 9 written out.
struct Worm {
  double lambda = 4.0 * std::acos(-1.0) / 180.0, phi = 20.0 * std::acos(-1.0) / 180.0, lw = 0.011, lg = 0.045;
  /// sign +1: friction helps the worm, C1; -1: it hinders it, C2.
  double C(double mu, int sign) const {
    const double m = sign * mu;
    return lw / lg * (std::cos(phi) * std::sin(lambda) - m * std::cos(lambda)) /
           (std::cos(phi) * std::cos(lambda) + m * std::sin(lambda));
  }
};

/// A break-in table of ten loads in both directions: motor torques with a relative error.
inline std::string break_in_csv(double mu, double noise, unsigned seed) {
  const Worm worm;
  std::mt19937 random(seed);
  std::normal_distribution<double> error(0.0, noise);
  std::string text = "load_torque_Nm,motor_torque_Nm\n";
  for (int k = 0; k < 10; ++k)
    for (const int sign : {1, -1}) {
      const double load = 0.2 + 0.13 * k;
      text += fmt::format("{},{:.9g}\n", load, -worm.C(mu, sign) * load * (1.0 + error(random)));
    }
  return text;
}

}  // namespace wormdrive::test
