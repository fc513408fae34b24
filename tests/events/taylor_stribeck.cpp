#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "core/numbers/exponential.hpp"
#include "support.hpp"

// Power series of a drive with a Stribeck curve by formulas of their own, against those of the equations of core/.

namespace wormdrive::test::events_taylor_stribeck {

namespace {

using System = WormDrive<double, GravityLoad>;
using Polynomials = Expansion<System::guard_count>;

struct Shape {
  double exponent, tail;
};
constexpr Shape shapes[] = {{1, 0}, {2, 0}, {3, 0}, {4, 0}, {1, 1}, {2, 1}, {3, 1}, {4, 1}};

Effects<double> stribeck_and_bearings(double drop, double speed, const Shape& shape) {
  return effects(Stribeck<double>{drop, speed, shape.exponent, shape.tail}, WormCoulomb<double>{2e-3},
                 GearCoulomb<double>{3e-3}, WormViscous<double>{2e-5}, GearViscous<double>{2e-4});
}

/// Largest deviation of two series over a step, in units of what the terms of the second come to.
double deviation(const Coefficients& a, const Coefficients& b, int order, double h) {
  double size = 0.0, apart = 0.0, power = 1.0;
  for (int k = 0; k <= order; ++k, power *= h) {
    size = std::max(size, std::abs(b[k]) * power);
    apart = std::max(apart, std::abs(a[k] - b[k]) * power);
  }
  return apart / std::max(size, 1e-3);
}

}  // namespace

TEST_CASE("the decaying exponential is the library's within a unit in the last place") {
  Deviation errors;
  for (double x = 0.0; x < 700.0; x += 0.0137) errors.add(decay(x) / std::exp(-x) - 1.0);
  REQUIRE(errors <= 4e-16);
  REQUIRE(decay(0.0) == 1.0);
  REQUIRE(decay(1e9) == 0.0);
}

TEST_CASE("a drive with a Stribeck curve has the series of the equations of core, for every shape and mode") {
  const TaylorAccuracy accuracy(tight(taylor, 1e-13));
  for (const Shape& shape : shapes)
    for (double drop : {0.1, -0.05, 0.0})
      for (const Mode mode : moving_modes)
        for (double speed : {1e-6, 0.05, 0.3, 3.0}) {
          const auto drive = entered(table1(), fig9_load(), fig9_motor(), stribeck_and_bearings(drop, 0.1, shape), 0.2);
          const System::Instant now{0.2, {0.4, sign(mode.motion) * speed}, mode};
          NominalFlow<System> flow(drive);
          REQUIRE(flow.covers());
          flow.begin(now);
          Polynomials own, general;
          flow.expand(now, 0.5, accuracy, own);
          SeriesFlow<System>{}.expand(drive, now, 0.5, accuracy, general);
          const int order = std::min(own.order, general.order);
          INFO("exponent " << shape.exponent << ", tail " << shape.tail << ", drop " << drop << ", speed " << speed);
          REQUIRE(order >= 8);
          REQUIRE(deviation(own.omega, general.omega, order, own.step) <= 1e-13);
          REQUIRE(deviation(own.theta, general.theta, order, own.step) <= 1e-13);
          for (int g = 0; g < System::guard_count; ++g)
            REQUIRE(deviation(own.guards[g], general.guards[g], order, own.step) <= 1e-13);
        }
}

TEST_CASE("under a Stribeck curve, one step without a search ends where short steps with one do") {
  int leaps = 0;
  Deviation angles, speeds;
  for (const Shape& shape : shapes)
    for (double tolerance : {1e-6, 1e-9, 1e-12})
      for (const Mode mode : moving_modes)
        for (double speed : {0.02, 0.1, 0.5, 2.0})
          for (double h : {1e-4, 1e-3, 5e-3})
            for (double torque : {-0.02, 0.02}) {
              const auto drive =
                  entered(table1(), fig9_load(), constant(torque), stribeck_and_bearings(0.1, 0.05, shape));
              const System::Instant start{0.0, {0.4, sign(mode.motion) * speed}, mode};
              if (drive.settle(start) != mode) continue;
              NominalFlow<System> flow(drive);
              flow.begin(start);
              System::Instant leapt = start;
              if (!flow.leap(leapt, h, TaylorAccuracy(tight(taylor, tolerance)))) continue;
              ++leaps;
              const auto exact = run(drive, Timetable(0, h, h / 4), start, tight(taylor, 1e-15));
              REQUIRE(exact.events.empty());
              const double allowed = h * tolerance * std::max(std::abs(leapt.x[1]), std::abs(start.x[1])) * 1.5;
              speeds.add((leapt.x[1] - exact.end.x[1]) / (allowed + 2e-15));
              angles.add((leapt.x[0] - exact.end.x[0]) / (h * allowed + 2e-15));
            }
  REQUIRE(leaps >= 300);
  REQUIRE(speeds <= 1.0);
  REQUIRE(angles <= 1.0);
}

}  // namespace wormdrive::test::events_taylor_stribeck
