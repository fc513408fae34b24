#include "core/elastic/impact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "compliant_drives.hpp"

// Restitution of an impact between teeth over decades of stiffness, mass, damping and speed, far beyond the critical
// damping.

namespace wormdrive::test::core_impact {

namespace {

/// Parting over approach speed by small steps of Runge-Kutta, shorter where the damper makes the motion faster.
double integrated(const ToothContact<double>& contact, double mass, double speed, double damping_rate, double share) {
  const double omega = contact_frequency(contact, mass);
  const auto rates = [&](double, const std::array<double, 2>& x) {
    return std::array<double, 2>{x[1], -contact.force(x[0], x[1]) / mass};
  };
  const auto drives_apart = [&](const std::array<double, 2>& x) {
    return x[1] < 0.0 && contact.force(x[0], x[1]) <= 0.0;
  };
  std::array<double, 2> x{0.0, speed}, before = x;
  double h = 0.0;
  while (!drives_apart(x)) {
    before = x;
    h = share / (omega + damping_rate);
    runge_kutta_step(rates, 0.0, x, h);
  }
  for (double low = 0.0, high = h; high - low > 1e-9 * h;) {  // the step within which they part, to its end
    const double middle = 0.5 * (low + high);
    x = before;
    runge_kutta_step(rates, 0.0, x, middle);
    (drives_apart(x) ? high : low) = middle;
  }
  return -x[1] / speed;
}

/// c v - ln(1 + c v), without the cancellation of its first terms.
long double invariant(long double x) {
  if (std::abs(x) > 0.1L) return x - std::log1p(x);
  long double sum = 0.0L, power = x;
  for (int k = 2; k < 40; ++k) sum += (power *= -x) / static_cast<long double>(-k);
  return sum;
}

constexpr double decades_of_stiffness[] = {1e2, 1e6, 1e11}, decades_of_mass[] = {1e-6, 0.5, 1e6};

}  // namespace

TEST_CASE("the limited damper's restitution is that of an integration, less and more than critically damped") {
  for (const double k : {1e4, 1e9})
    for (const double mass : {1e-3, 20.0})
      for (const double zeta : {1e-3, 0.1, 0.4, 0.5, 0.9, 1.0 - 1e-6, 1.0, 1.0 + 1e-6, 1.2, 3.0, 30.0, 300.0}) {
        const double D = 2.0 * zeta * std::sqrt(k * mass);
        const ToothContact<double> contact{LimitedDamper<double>{k, D}, 0.0};
        INFO("zeta " << zeta);
        const double by_steps = integrated(contact, mass, 0.1, D / mass, 1e-3);
        CHECK(close(restitution(contact, mass, 0.1), by_steps, 1e-5));
      }
}

TEST_CASE("the limited damper's restitution depends on the share of critical damping alone, and falls with it to 0") {
  const auto of = [](double k, double mass, double zeta, double speed) {
    return restitution({LimitedDamper<double>{k, 2.0 * zeta * std::sqrt(k * mass)}, 0.0}, mass, speed);
  };
  double before = 1.0;
  for (double zeta = 1e-12; zeta < 1e30; zeta *= 1.07) {
    const double e = of(1.0, 1.0, zeta, 1.0);
    CHECK((e <= before && e > 0.0));
    before = e;
    for (const double k : decades_of_stiffness)
      for (const double mass : decades_of_mass)
        for (const double speed : {1e-6, 10.0}) CHECK(close(of(k, mass, zeta, speed), e, 1e-13));
  }
  CHECK(of(1.0, 1.0, 0.0, 1.0) == 1.0);
  CHECK(close(of(1.0, 1.0, 1.0, 1.0), std::exp(-4.0 / 3.0), 1e-14));
  CHECK(close(of(1.0, 1.0, 1.0 - 1e-12, 1.0), std::exp(-4.0 / 3.0), 1e-11));
  CHECK(close(of(1.0, 1.0, 1.0 + 1e-12, 1.0), std::exp(-4.0 / 3.0), 1e-11));
  CHECK(close(1.0 - of(1.0, 1.0, 1e-6, 1.0), 1e-6 * std::numbers::pi, 1e-5));      // half a period, hardly damped
  CHECK(close(of(1.0, 1.0, 1e9, 1.0), 1.0 / (2.0 * std::sqrt(2.0) * 1e9), 1e-9));  // the damper takes all but this
}

TEST_CASE("with damping that grows with the penetration c v - ln(1 + c v) is kept, for any damping") {
  for (double c = 1e-12; c < 1e15; c *= 3.0)
    for (const double speed : {1e-6, 0.1, 10.0})
      for (const double k : decades_of_stiffness) {
        const long double x = static_cast<long double>(c) * speed;
        const double e = restitution({HuntCrossley<double>{k, c}, 0.0}, 0.5, speed);
        INFO("c v = " << static_cast<double>(x) << ", e = " << e);
        REQUIRE((e > 0.0 && e <= 1.0));
        // by how much the invariant misses, over how much it changes with the speed of parting: y/(1 - y)
        const long double y = x * e, missing = invariant(-y) - invariant(x);
        if (y < 1.0L - 1e-14L)
          CHECK(std::abs(missing) <= 1e-13L * y * (y / (1.0L - y) + invariant(x)));
        else
          CHECK(close(e, static_cast<double>(1.0L / x), 1e-13));
      }
  CHECK(restitution({HuntCrossley<double>{1e6, 0.0}, 0.0}, 0.5, 0.1) == 1.0);
}

TEST_CASE("damping that grows with the penetration has the restitution of an integration") {
  for (const double x : {1e-3, 0.03, 0.3, 1.0, 3.0, 30.0, 300.0}) {
    const double k = 1e6, mass = 0.5, speed = 0.1;
    const ToothContact<double> contact{HuntCrossley<double>{k, x / speed}, 0.0};
    INFO("c v = " << x);
    const double by_steps = integrated(contact, mass, speed, x * contact_frequency(contact, mass), 1e-3);
    CHECK(close(restitution(contact, mass, speed), by_steps, 1e-6));
  }
}

}  // namespace wormdrive::test::core_impact
