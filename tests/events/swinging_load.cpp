#include <cmath>
#include <random>

#include "catch.hpp"
#include "support.hpp"

// A guard may swing with the angle while the motion itself does not feel it. Where C = 0 the gear's inertia and load do
// not reach the worm: theta_g'' = tau_m/(Jw i), to be integrated in steps of any length, while the load of a swinging
// arm passes the switching surface twice per turn. Closed form of the first time: theta_g = acos(tau_m/(K amplitude)),
// K = Jw i/Jg.

namespace wormdrive::test::events_swinging_load {

TEST_CASE("a load that swings past the switching surface within a step of the solver changes the flank") {
  std::mt19937_64 random(2026);
  const auto within = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  MeshParameters<double> p = table1();
  p.mu = std::cos(p.phi_n) * std::tan(p.lambda);  // C(mu) = 0
  const double K = p.Jw * p.i / p.Jg;
  for (int k = 0; k < 40; ++k) {
    const double torque = std::pow(10.0, within(-4.0, 3.0)), share = within(0.3, 0.95);
    GravityArm arm;
    arm.amplitude = torque / (K * share);
    const double crossing = std::sqrt(2.0 * std::acos(share) * p.Jw * p.i / torque);
    for (const double tolerance : {1e-3, 1e-6, 1e-12})
      for (const By by : every_solver) {
        const auto r = run(drive(p, arm, constant(torque)), Timetable(0, 1.5 * crossing, 2.0 * crossing), {},
                           tight(by, tolerance));
        CAPTURE(k, torque, share, tolerance, static_cast<int>(by.solver), static_cast<int>(by.method));
        REQUIRE(r.rows.front().now.mode == Mode{Motion::forward, Flank::left});
        REQUIRE_FALSE(r.events.empty());
        REQUIRE(r.events.front().after.mode == Mode{Motion::forward, Flank::right});
        REQUIRE(std::abs(r.events.front().after.t - crossing) <= (1e-11 + 10.0 * tolerance) * crossing);
      }
  }
}

}  // namespace wormdrive::test::events_swinging_load
