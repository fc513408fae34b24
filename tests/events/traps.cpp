#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "catch.hpp"
#include "support.hpp"

// One test for every numerical trap of a drive that sticks, reverses and changes flank. Each fails when the line that
// cures its trap is taken out.

namespace wormdrive::test::events_traps {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr Mode forward_left{Motion::forward, Flank::left}, forward_right{Motion::forward, Flank::right},
    backward_left{Motion::backward, Flank::left}, backward_right{Motion::backward, Flank::right}, stuck{};

/// peak cos(2 pi t + pi): the highest torque comes at t = 0.5, 1.5, ...
Signal peaks_at_half(double peak) {
  return {{Sinusoid{.amplitude = peak, .frequency = 1.0, .phase = std::numbers::pi}}};
}

}  // namespace

TEST_CASE("a break-away with neither speed nor acceleration goes the way of the boundary that was crossed") {
  // Without load the stick region is the point tau_m = 0: at t = 0 speed and acceleration vanish, on the first the
  // torque's rate alone decides, on the second even that is zero.
  const double rate = 0.04, A = 0.01, omega = 2.0 * std::numbers::pi;
  const Branch in(table1(), forward_right);
  for (int side : {1, -1}) {
    const Mode moved = side > 0 ? forward_right : backward_left;
    const auto ramped = run(drive(table1(), constant(0.0), Signal{{Ramp{side * rate}}}), Timetable(0, 1, never), {});
    REQUIRE(ramped.modes() == std::vector{stuck, moved});
    REQUIRE(ramped.events[0].after.t == 0.0);
    REQUIRE(std::abs(ramped.end.x[1] * side - rate / in.M / 2.0) <= 1e-10);

    const Signal bulge{{Constant{side * A}, Sinusoid{.amplitude = -side * A, .frequency = 1.0}}};
    const auto bulged = run(drive(table1(), constant(0.0), bulge), Timetable(0, 0.9, never), {});
    REQUIRE(bulged.modes() == std::vector{stuck, moved});
    REQUIRE(std::abs(bulged.end.x[1] * side - A / in.M * (0.9 - std::sin(omega * 0.9) / omega)) <= 1e-10);
  }
}

TEST_CASE("a ramp that releases a held load starts one motion, whatever the rounding of the release") {
  for (int k = 0; k < 200; ++k) {
    const double load = 0.01 + 0.0037 * k, rate = 0.03 + 0.0011 * k;
    for (int side : {1, -1}) {
      const auto r = run(drive(table1(), constant(load * side), Signal{{Ramp{rate * side}}}), Timetable(0, 2, never),
                         {}, tight(adams, 1e-10));
      REQUIRE_FALSE(r.events.empty());
      REQUIRE(r.events.size() <= 2);  // released, and later over the switching surface
      REQUIRE(sign(r.events[0].after.mode.motion) == side);
      REQUIRE(sign(r.end.mode.motion) == side);
    }
  }
}

TEST_CASE("a start that lies on the switching surface takes the flank of the first derivative that does not vanish") {
  const double A = 0.01, omega = 2.0 * std::numbers::pi;
  // tau_m leaves the surface to the right with its first, with its second derivative
  const Signal by_rate{{Ramp{0.04}}}, by_curvature{{Constant{A}, Sinusoid{.amplitude = -A, .frequency = 1.0}}};
  const Branch in(table1(), forward_right);
  const auto first = run(drive(table1(), constant(0.0), by_rate), Timetable(0, 0.8, never), {0, {0, 1.0}, {}});
  REQUIRE(first.modes() == std::vector{forward_right});
  REQUIRE(std::abs(first.end.x[1] - (1.0 + 0.04 / in.M * 0.32)) <= 1e-10);
  const auto second = run(drive(table1(), constant(0.0), by_curvature), Timetable(0, 0.8, never), {0, {0, 1.0}, {}});
  REQUIRE(second.modes() == std::vector{forward_right});
  REQUIRE(std::abs(second.end.x[1] - (1.0 + A / in.M * (0.8 - std::sin(omega * 0.8) / omega))) <= 1e-10);
}

TEST_CASE("speed zero and torque crossing at one instant leave the drive on the flank that the torque turns to") {
  // Forward and left until t = 1/2, where the speed ends just when tau_m = (Jw i/Jg) tau_l; then backward and right.
  const MeshParameters<double> p = table1();
  const Branch in(p, forward_left);
  const double surface = p.Jw * p.i / p.Jg, meet = 0.5;
  for (int k = 1; k <= 100; ++k) {
    const double load = -0.0004 * k, rate = 0.003 * k;
    const double omega = -load / p.Jg * meet + rate / in.M * meet * meet / 2.0;
    const Signal motor{{Constant{surface * load - rate * meet}, Ramp{rate}}};
    const auto r = run(drive(p, constant(load), motor), Timetable(0, 0.7, never), {0, {0, omega}, {}});
    REQUIRE(r.rows.front().now.mode == forward_left);
    REQUIRE(r.end.mode == backward_right);
    // rounding may give the two events an ulp of distance and either order, never a third mode that lasts
    for (const auto& event : r.events) REQUIRE(std::abs(event.after.t - meet) <= 1e-12);
    REQUIRE(std::abs(r.end.x[1] - (load / p.Jg * 0.2 + rate / in.M * 0.02)) <= 1e-10);
  }
}

TEST_CASE("a drive at rest finds every short window in which the torque lets go, however long it has been stuck") {
  // Six exits through each boundary, each open for 3% of a period and closed long enough for any step to grow over it.
  const MeshParameters<double> p = table1();
  const GearMesh<double> mesh(p);
  const double load = 0.69, excess = 0.005;
  const double early = std::acos(1.0 / (1.0 + excess)) / (2.0 * std::numbers::pi);
  const double break_in[] = {-mesh.C1() * load, -mesh.C2() * load};
  for (int boundary : {0, 1})
    for (const SolverSettings& settings : {SolverSettings{}, tight(adams)}) {
      const double peak = break_in[boundary] * (1.0 + excess);
      // the other boundary is further away in one case, and held off by a constant in the other
      const Signal motor = boundary == 0
                               ? peaks_at_half(peak)
                               : Signal{{Constant{peak / 2},
                                         Sinusoid{.amplitude = peak / 2, .frequency = 1.0, .phase = std::numbers::pi}}};
      const double open = boundary == 0 ? early : std::acos(2.0 / (1.0 + excess) - 1.0) / (2.0 * std::numbers::pi);
      const auto r = run(drive(p, constant(load), motor), Timetable(0, 6, never), {}, settings);
      REQUIRE(r.events.size() == 12);
      for (int k = 0; k < 6; ++k) {
        REQUIRE(r.events[2 * k].before.mode == stuck);
        REQUIRE(sign(r.events[2 * k].after.mode.motion) == (boundary == 0 ? 1 : -1));
        REQUIRE(std::abs(r.events[2 * k].after.t - (k + 0.5 - open)) <= 1e-12);
        REQUIRE(r.events[2 * k + 1].after.mode == stuck);
      }
    }
}

TEST_CASE("two boundaries crossed within one step of the search release the drive through the earlier one") {
  // A stick region of 1.3e-6 N m: the torque leaves it on one side, turns and passes the other within 0.03 rad of
  // phase.
  const double load = 1e-5, A = 0.05, omega = 2.0 * std::numbers::pi, begin = 1.0 - 0.0063 / omega;
  const double released = 1.0 - std::acos(1.0 - (1e-6 + GearMesh<double>(table1()).C1() * load) / A) / omega;
  for (int side : {1, -1}) {
    const Signal motor{{Constant{side * (1e-6 - A)}, Sinusoid{.amplitude = side * A, .frequency = 1.0}}};
    const auto r =
        run(drive(table1(), constant(side * load), motor), Timetable(begin, 1.01, never), {begin, {0, 0}, {}});
    REQUIRE(r.rows.front().now.mode == stuck);
    REQUIRE(sign(r.events[0].after.mode.motion) == side);
    REQUIRE(std::abs(r.events[0].after.t - released) <= 1e-12);
  }
}

TEST_CASE("an event on a report, an ulp beside it or on a knot loses neither the event nor the report") {
  // A single inertia of 1 kg m^2 under -1 N m turns back at t = omega: at every one of its reports in turn.
  for (int k = 1; k <= 40; ++k)
    for (double nudge : {0.0, -1.0, 1.0}) {
      const double due = k * 0.1;
      const double omega = nudge == 0.0 ? due : std::nextafter(due, nudge * never);
      const Signal motor{{Constant{-1.0}, Staircase{.rise = -1e-3, .interval = 0.1, .start = 5.0}}};
      const auto r =
          run(WormDrive(GearMesh<double>::without_teeth(1.0), make_load(constant(0.0)), Effects<double>{}, motor),
              Timetable(0, 6, 0.1), {0, {0, omega}, {}});
      REQUIRE(r.events.size() == 1);
      REQUIRE(std::abs(r.events[0].after.t - omega) <= 1e-12);
      int missing = 0;
      for (int report = 1; report < 60; ++report)
        missing +=
            std::none_of(r.rows.begin(), r.rows.end(), [&](const auto& row) { return row.now.t == report * 0.1; });
      REQUIRE(missing == 0);
    }
}

TEST_CASE("a report at a reversal, or a few ulps beside it, shows no speed against its motion") {
  // The speed of a single inertia is v (1 - t/t1) (1 - t/t2): a polynomial, which CVODE follows in steps so long that
  // rounding of a state between two of them is as large as the speed near t1.
  std::mt19937_64 random(4);
  const auto decades = [&](double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution(low, high)(random));
  };
  for (int k = 0; k < 60; ++k) {
    const double J = decades(-6, 0), v = decades(-2, 4), t1 = decades(-3, 3), t2 = t1 * (1.0 + decades(-4, 0));
    const Signal motor{{Constant{-J * v * (1.0 / t1 + 1.0 / t2)}, Ramp{2.0 * J * v / (t1 * t2)}}};
    for (const By by : every_solver)
      for (int ulps = -6; ulps <= 6; ++ulps) {
        double due = t1;
        for (int n = 0; n < std::abs(ulps); ++n) due = std::nextafter(due, ulps * never);
        const auto r =
            run(WormDrive(GearMesh<double>::without_teeth(J), make_load(constant(0.0)), Effects<double>{}, motor),
                Timetable(0.0, 1.5 * due, due), {0.0, {0.0, v}, {}}, tight(by, 1e-12));
        for (std::size_t row = 0; row + 1 < r.rows.size(); ++row) {
          const auto& now = r.rows[row].now;
          if (r.rows[row + 1].now.t == now.t) continue;  // the left limit of an event
          CAPTURE(k, t1, t2, ulps, now.t, now.x[1], static_cast<int>(by.solver), static_cast<int>(by.method));
          CHECK(sign(now.mode.motion) * now.x[1] >= 0.0);
        }
      }
  }
}

TEST_CASE("a drive at rest gets past a report that lies an ulp behind a knot") {
  // 3 * 0.1 is the double after 0.3: between the step and the report there is no room for a search.
  const auto r = run(drive(table1(), constant(0.1), Signal{{Step{1e-6, 0.3}}}), Timetable(0, 1, 0.1), {});
  REQUIRE(r.modes() == std::vector{stuck});
  REQUIRE(r.end.t == 1.0);
}

TEST_CASE("a stop is exact and for good: the speed is 0 and not a rounding of it, and no later step wakes the drive") {
  // Knots every 0.1 s let the drive settle anew; a speed of 1e-17 left over would count as motion there.
  const Signal motor{{Staircase{.rise = 1e-9, .interval = 0.1}}};
  for (int k = 1; k <= 25; ++k)
    for (int side : {1, -1}) {
      const auto r = run(drive(table1(), constant(-0.02 * side), motor), Timetable(0, 3, 0.07),
                         {0.0, {0.0, side * 0.11 * k}, {}}, tight(adams, 1e-9));
      REQUIRE(r.events.size() == 1);
      REQUIRE(r.end.mode == stuck);
      for (const auto& row : r.rows)
        if (row.now.mode == stuck) REQUIRE((row.now.x[1] == 0.0 && row.now.x[0] == r.end.x[0]));
    }
}

TEST_CASE("a tie sticks: on the very boundary nothing moves until the boundary is passed") {
  for (double rate : {0.0, 1.0, -1.0}) {
    const auto d = entered(table1(), constant(0.0), Signal{{Ramp{rate}}});
    REQUIRE(d.settle({}) == stuck);
  }
  const auto bearing = WormDrive(GearMesh<double>::without_teeth(1.0), make_load(constant(0.0)),
                                 effects(GearCoulomb<double>{0.5}), Signal{{Constant{0.5}, Step{0.5, 1.0}}});
  const auto r = run(bearing, Timetable(0, 2, 0.1), {});
  REQUIRE(r.modes() == std::vector{stuck, Mode{Motion::forward, Flank::none}});
  REQUIRE(r.events[0].after.t == 1.0);
}

namespace {

/// A drive that counts how often it is asked.
struct CountedDrive : WormDrive<double, GravityLoad> {
  using Drive = WormDrive<double, GravityLoad>;
  using Drive::Drive;
  mutable long derivatives = 0, jacobians = 0;

  State derivative(double t, const State& x, Mode mode) const { return ++derivatives, Drive::derivative(t, x, mode); }
  Jacobian jacobian(double t, const State& x, Mode mode) const { return ++jacobians, Drive::jacobian(t, x, mode); }
};

}  // namespace

TEST_CASE("what the solver reports to have done is what the drive was asked for, over all restarts together") {
  for (By method : {bdf, adams}) {
    CountedDrive d(GearMesh<double>(table1()), make_load(fig9_load()), {}, fig9_motor());
    CvodeSolver<CountedDrive> solver(d, tight(method, 1e-10));
    simulate(d, solver, Timetable(0, 2, 0.01), {}, [](const auto&, const auto&) {});
    const SolverStatistics total = solver.statistics();
    REQUIRE(total.restarts == 12);  // one for each event; at rest nothing is integrated
    REQUIRE(total.evaluations == d.derivatives);
    REQUIRE(total.jacobians == d.jacobians);
    REQUIRE((total.steps > 100 && total.steps < total.evaluations && total.steps < total.guard_evaluations));
  }
}

}  // namespace wormdrive::test::events_traps
