#include <algorithm>
#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "core/statics.hpp"
#include "near_ties/dice.hpp"
#include "support.hpp"

// Stops that push only, against the half swing of a mass on a spring, the law of Hunt and Crossley, and what statics
// say of a gear that was driven into one.

namespace wormdrive::test::events_end_stops {

namespace {

EndStops beyond(double angle, double stiffness, double damping = 0.0) {
  EndStops stops;
  stops.high = angle;
  stops.stiffness = stiffness;
  stops.damping = damping;
  return stops;
}

/// One inertia without teeth that runs into a stop.
auto free_running(double J, const EndStops& stops) {
  return WormDrive<double, SummedLoad>(GearMesh<double>::without_teeth(J), make_load(LoadSum{{stops}}), {}, Signal{});
}

}  // namespace

TEST_CASE("a mass that runs into an elastic stop comes back with its speed after half a swing, at every scale") {
  near_ties::Dice dice(7, 0);
  for (int drawn = 0; drawn < 40; ++drawn) {
    const double J = dice.decades(1e-6, 10), speed = dice.decades(1e-3, 100), way = dice.decades(1e-4, 10);
    const double approach = way / speed, swing = std::numbers::pi / (approach * dice.decades(1e-4, 3));  // [rad/s]
    EndStops stops = beyond(0.3 + way, J * swing * swing);
    const int side = dice.chance(0.5) ? 1 : -1;
    if (side < 0) {
      stops.low = 0.3 - way;
      stops.high.reset();
    }
    const double contact = std::numbers::pi / swing, end = 2.0 * approach + contact;
    for (const By by : every_solver) {
      // angles are known to the tolerance's share of themselves, and of the depth that is much less
      const double depth = speed / swing, allowed = 1e-9 + 1e-12 * (0.3 + way) / depth;
      INFO("J " << J << ", speed " << speed << ", way " << way << ", contact " << contact << " s");
      SolverSettings settings = tight(by, 1e-12);
      settings.absolute_tolerance = 1e-13 * std::min(way, speed);
      const auto d = free_running(J, stops);
      const auto seen = run(d, Timetable(0, end, end / 7), {0, {0.3, side * speed}, {}}, settings);
      REQUIRE(std::abs(seen.end.x[0] - 0.3) <= allowed * way + 1e-13);
      REQUIRE(std::abs(seen.end.x[1] + side * speed) <= allowed * speed);
      REQUIRE(seen.events.size() == 1);
      REQUIRE(std::abs(seen.events[0].after.t - (approach + 0.5 * contact)) <= allowed * end);
      REQUIRE(std::abs(side * (seen.events[0].after.x[0] - 0.3) - (way + depth)) <= allowed * (way + depth));
    }
  }
}

TEST_CASE("a damped stop gives back the speed that the law of Hunt and Crossley leaves") {
  // v/(1 + c v) dv = -(k/J) d dd: what v/c - ln(1 + c v)/c^2 is on the way in, it is on the way out
  for (const double damped : {0.01, 0.3, 2.0, 30.0}) {
    const double J = 2e-3, speed = 1.5, c = damped / speed;
    const auto stored = [c](double v) { return v / c - std::log1p(c * v) / (c * c); };
    double slow = 0.0, fast = std::min(speed, (1.0 - 1e-15) / c);
    for (int k = 0; k < 200; ++k) {
      const double v = 0.5 * (slow + fast);
      (stored(-v) < stored(speed) ? slow : fast) = v;
    }
    for (const By by : every_solver) {
      const auto seen =
          run(free_running(J, beyond(0.5, 40.0, c)), Timetable(0, 3, 0.1), {0, {0, speed}, {}}, tight(by, 1e-12));
      REQUIRE(std::abs(seen.end.x[1] + slow) <= 1e-9 * speed);
    }
  }
}

TEST_CASE("a gear that locks itself stays wedged in a stop, and it takes its break-in torque to free it") {
  const MeshParameters<double> p = table1();
  const double push = 0.05, rate = 0.05, off = 3.0, pull = 4.0;
  const Signal motor{{Step{push, 0.0}, Step{-push, off}, Ramp{.rate = -rate, .start = pull}}};
  for (const By by : every_solver) {
    const auto seen = run(drive(p, LoadSum{{beyond(0.2, 30.0, 0.5)}}, motor), Timetable(0, 8, 0.1), {}, tight(by));
    REQUIRE(seen.events.size() >= 2);
    const auto& start =
        *std::find_if(seen.events.begin(), seen.events.end(), [&](const auto& e) { return e.after.t >= pull; });
    const double depth = start.before.x[0] - 0.2, load = -30.0 * depth;
    REQUIRE(depth > 1e-3);
    REQUIRE(start.before.mode.motion == Motion::stuck);
    REQUIRE(start.after.mode.motion == Motion::backward);
    const BreakInTorques needed = break_in_torques(GearMesh<double>(p), load);
    REQUIRE(std::abs(-rate * (start.after.t - pull) - *needed.backward) <= 1e-12);
  }
}

TEST_CASE("an arm that falls into a stop comes to rest where the stop carries it, though nothing but the teeth rubs") {
  // The friction of the teeth vanishes with the load that rests in the stop, so the last swings are those of rounding.
  near_ties::Dice dice(11, 0);
  for (int drawn = 0; drawn < 24; ++drawn) {
    const double mu = dice.between(0.05, 0.1), ratio = std::round(dice.between(5.0, 40.0)),
                 lead = dice.between(10.0, 25.0) * unit::degree;
    MeshParameters<double> p = closing(table1(mu), ratio, lead);
    p.Jg = dice.decades(1e-5, 1e-1);
    p.Jw = p.Jg / (p.i * p.i) * dice.decades(0.03, 3.0);
    GravityArm arm;
    const double weight = dice.decades(0.1, 10.0), high = dice.between(0.01, 1.0), stiffness = dice.decades(10.0, 1e5);
    arm.amplitude = weight;
    const EndStops stops = beyond(high, stiffness, dice.chance(0.3) ? 0.0 : dice.decades(0.01, 1.0));
    double carried = high;  // weight cos(theta) = stiffness (theta - high), by Newton's method
    for (int k = 0; k < 50; ++k)
      carried += (weight * std::cos(carried) - stiffness * (carried - high)) / (weight * std::sin(carried) + stiffness);
    const double J = p.Jg + p.i * p.i * p.Jw, swings = 6e3 * std::sqrt(J / stiffness);
    const Timetable times(0, swings + 30.0 * std::sqrt(J / weight), swings);
    INFO("drawn " << drawn << ": weight " << weight << ", stop at " << high << " of " << stiffness << " N m/rad");
    const auto seen = run(drive(p, LoadSum{{arm, stops}}, Signal{}), times, {}, tight(taylor, 1e-10));
    REQUIRE(std::abs(seen.end.x[1]) <= 1e-9);
    REQUIRE(std::abs(seen.end.x[0] - carried) <= 1e-12);
  }
}

}  // namespace wormdrive::test::events_end_stops
