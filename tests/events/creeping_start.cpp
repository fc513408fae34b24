#include <cmath>
#include <numbers>
#include <random>

#include "catch.hpp"
#include "core/statics.hpp"
#include "support.hpp"

// A load that falls within days from what just holds the gear leaves it with an acceleration of nothing. Friction that
// falls over the speed carries it off all the same: what moves by less than an absolute tolerance is not at rest.

namespace wormdrive::test::events_creeping_start {

TEST_CASE("a gear that leaves rest by next to nothing is carried off by friction that falls", "[slow]") {
  std::mt19937_64 random(2026);
  const auto decades = [&](double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution(low, high)(random));
  };
  for (int k = 0; k < 30; ++k) {
    MeshParameters<double> p = table1();
    const double size = decades(-3.0, 3.0), load = -size * decades(-2.0, 1.0), mu = p.mu;
    p.Jw *= size * decades(-1.0, 1.0);
    p.Jg *= size * decades(-1.0, 1.0);
    const GearMesh<double> mesh(p);
    const double hold = *break_in_torques(mesh, load).forward, drop = 0.1 * mu;
    // friction falls by a tenth over a gear speed that it gives the gear within 0.1 us to 0.1 s
    const double inertia = p.Jw * p.i + mesh.C2() * p.Jg;
    const double pull = std::abs((mesh.C2() - mesh.C(drop - mu)) * load) / inertia, takes = decades(-7.0, -1.0);
    // rounding hides the fall of the load for some 1e-8 periods
    const double period = takes * decades(8.0, 11.0), end = 1e4 * takes;
    Effects<double> effects;
    std::get<std::optional<Stribeck<double>>>(effects.list) =
        Stribeck<double>{.drop = drop, .speed = std::abs(mesh.sliding_speed(p.i * pull * takes))};
    const Signal falling{{Constant{0.8 * load}, Sinusoid{.amplitude = 0.2 * load, .frequency = 1.0 / period}}};
    for (const By by : every_solver) {
      auto settings = tight(by, 1e-12);
      settings.absolute_tolerance = 1e-14 * pull * takes;
      CAPTURE(k, size, load, hold, period, pull, takes, static_cast<int>(by.solver), static_cast<int>(by.method));
      const auto r =
          run(WormDrive(mesh, make_load(falling), effects, constant(hold)), Timetable(0.0, end, end), {}, settings);
      CHECK(r.events.size() < 10);  // again, where the first start is rounding
      CHECK(r.end.mode.motion == Motion::forward);
      CHECK(r.end.x[1] > pull * takes);
    }
  }
}

TEST_CASE("a gear that only rounding moves off does not creep where friction falls over the speed") {
  std::mt19937_64 random(19);
  const auto decades = [&](double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution(low, high)(random));
  };
  for (int k = 0; k < 40; ++k) {
    MeshParameters<double> p = table1();
    const double size = decades(-3.0, 3.0), frequency = decades(-6.0, -2.0), drop = decades(-3.0, -0.5) * p.mu;
    p.Jw *= size * decades(-1.0, 1.0);
    p.Jg *= size * decades(-1.0, 1.0);
    const GearMesh<double> mesh(p);
    // motor and load pass through zero together, each at all times the one that the other just holds
    const double hold = *break_in_torques(mesh, -size).forward;
    const double phase = decades(-3.0, 0.0), omega_s = decades(-9.0, -5.0);
    const auto wave = [&](double amplitude) { return Signal{{Sinusoid{amplitude, frequency, phase}}}; };
    const Stribeck<double> stribeck{.drop = drop, .speed = std::abs(mesh.sliding_speed(p.i * omega_s))};
    const auto d = drive(p, wave(-size), wave(hold), effects(stribeck));
    for (const By by : every_solver) {
      auto settings = tight(by, 1e-12);
      settings.absolute_tolerance *= frequency;
      CAPTURE(k, size, frequency, drop, omega_s, static_cast<int>(by.solver), static_cast<int>(by.method));
      double begin = 0.0, rate = 0.0;
      const auto r = run(d, Timetable(0.0, 10.0, 0.05), {}, settings);
      for (const auto& row : r.rows) {
        if (row.now.mode.motion == Motion::stuck) {
          begin = row.now.t;
          auto at = drive(p, wave(-size), wave(hold), effects(stribeck));
          at.enter(begin);
          const Mode mode{Motion::forward, Flank::right};
          const auto acceleration = [&](double omega) { return at.acceleration(at.moment(begin, 0.0, omega), mode); };
          rate = (acceleration(0.01 * omega_s) - acceleration(0.0)) / (0.01 * omega_s);
        } else if ((row.now.t - begin) * rate > 200.0) {
          CHECK((row.now.x[1] == 0.0 || std::abs(row.now.x[1]) > omega_s));  // not begun, or carried off
        }
      }
    }
  }
}

TEST_CASE("friction that does not fall yet, for the load passes through zero, carries the gear off when it does") {
  std::mt19937_64 random(61);
  const auto decades = [&](double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution(low, high)(random));
  };
  for (int k = 0; k < 40; ++k) {
    MeshParameters<double> p = table1();
    const double size = decades(-3.0, 3.0), drop = decades(-3.0, -0.5) * p.mu;
    p.Jw *= size * decades(-1.0, 1.0);
    p.Jg *= size * decades(-1.0, 1.0);
    const GearMesh<double> mesh(p);
    const double omega_s = decades(-6.0, 2.0), inertia = p.Jw * p.i + mesh.C2() * p.Jg;
    const double growth = std::abs((mesh.C(drop - p.mu) - mesh.C2()) * size) / inertia / omega_s;
    // far more growth within a quarter period than takes the gear from a millionth of that speed to it
    const double frequency = growth / decades(2.5, 5.0);
    const double hold = *break_in_torques(mesh, -size).forward;
    const auto wave = [&](double amplitude) {
      return Signal{{Sinusoid{amplitude, frequency, -0.5 * std::numbers::pi}}};
    };
    const Stribeck<double> stribeck{.drop = drop, .speed = std::abs(mesh.sliding_speed(p.i * omega_s))};
    const auto d = drive(p, wave(-size), wave(hold), effects(stribeck));
    const double quarter = 0.25 / frequency;
    for (const By by : every_solver) {
      auto settings = tight(by, 1e-12);
      settings.absolute_tolerance = 1e-3 * omega_s;  // which the start is far below
      CAPTURE(k, size, frequency, growth, omega_s, static_cast<int>(by.solver), static_cast<int>(by.method));
      const auto r = run(d, Timetable(0.0, quarter, quarter),
                         {0.0, {0.0, 1e-6 * omega_s}, {Motion::forward, Flank::right}}, settings);
      CHECK(r.events.empty());
      CHECK(r.end.x[1] > omega_s);
    }
  }
}

TEST_CASE("a speed far below the tolerance is a motion of its own: what gains it goes on, and stops in its time") {
  std::mt19937_64 random(28);
  const auto decades = [&](double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution(low, high)(random));
  };
  for (int k = 0; k < 40; ++k) {
    // a torque that rises to little more than the bearings hold, and falls again: J omega' = torque - 1
    const double J = decades(-4.0, 2.0), excess = decades(-8.0, -2.0), start = 1.0 / (1.0 + excess);
    const double rate = (1.0 + excess) / J;  // of the acceleration, which is excess/J at the knot
    const double gained = 0.5 * rate * (1.0 - start) * (1.0 - start);
    const double later = (excess / J + std::sqrt(excess / J * (excess / J) + 2.0 * rate * gained)) / rate;
    const Samples triangle{
        .times = {0.0, 1.0, 2.0}, .values = {0.0, 1.0 + excess, 0.0}, .interpolation = Interpolation::linear};
    Effects<double> effects;
    std::get<std::optional<WormCoulomb<double>>>(effects.list) = WormCoulomb<double>{.torque = 1.0};
    for (const By by : every_solver)
      for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-10}) {
        CAPTURE(k, J, excess, tolerance, static_cast<int>(by.solver), static_cast<int>(by.method));
        const auto r =
            run(WormDrive(GearMesh<double>::without_teeth(J), make_load(Signal{}), effects, Signal{{triangle}}),
                Timetable(0.0, 2.0, 2.0), {}, tight(by, tolerance));
        REQUIRE(r.events.size() == 2);
        CHECK(std::abs(r.events[0].after.t - start) <= 1e-6 * excess + 1e-15);
        CHECK(std::abs(r.events[1].after.t - 1.0 - later) <= 0.05 * later + 1e-15);
        CHECK(r.end.x[0] > -0.01 * tolerance);  // less is not known of it
      }
  }
}

}  // namespace wormdrive::test::events_creeping_start
