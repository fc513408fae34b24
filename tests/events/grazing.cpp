#include <cmath>
#include <limits>
#include <numbers>

#include "catch.hpp"
#include "support.hpp"

// A guard that only just reaches zero, or dips below it and comes back within one step: no sign changes at step ends.

namespace wormdrive::test::events_grazing {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr Mode forward_left{Motion::forward, Flank::left}, forward_right{Motion::forward, Flank::right}, stuck{};

/// peak cos(2 pi t + pi): the highest torque comes at t = 0.5, 1.5, ...
Signal peaks_at_half(double peak) {
  return {{Sinusoid{.amplitude = peak, .frequency = 1.0, .phase = std::numbers::pi}}};
}

}  // namespace

TEST_CASE("a speed that dips below zero for less than a solver step stops the drive and starts it again") {
  // Forward and left along a parabola of the speed whose lowest point lies at t = 1, where tau_m = -C1 tau_l. A method
  // of third order follows it exactly, so its steps grow over any dip.
  const MeshParameters<double> p = table1();
  const Branch in(p, forward_left);
  const double load = 0.03, rate = 0.001, bend = rate / in.M / 2.0;
  const Signal motor{{Constant{-in.C * load - rate}, Ramp{rate}}};
  for (By method : every_solver)
    for (double depth : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8, 1e-9}) {
      const auto dips =
          run(drive(p, constant(load), motor), Timetable(0, 1.5, never), {0, {0, bend - depth}, {}}, tight(method));
      REQUIRE(dips.modes() == std::vector{forward_left, stuck, forward_left});
      const double early = std::sqrt(depth / bend);
      REQUIRE(std::abs(dips.events[0].after.t - (1.0 - early)) <= 1e-12 / early);
      REQUIRE(std::abs(dips.events[1].after.t - 1.0) <= 1e-12);
      REQUIRE(std::abs(dips.end.x[1] - bend * 0.25) <= 1e-10);

      const auto passes =
          run(drive(p, constant(load), motor), Timetable(0, 1.5, never), {0, {0, bend + depth}, {}}, tight(method));
      REQUIRE(passes.modes() == std::vector{forward_left});
    }
}

TEST_CASE("a torque beyond the switching surface for less than a solver step loads the other flank meanwhile") {
  const double A = 0.01;
  for (By method : every_solver)
    for (double excess : {1e-3, 1e-5, 1e-7}) {
      // without load the surface is tau_m = 0, topped at t = 0.5
      const Signal motor{
          {Constant{-A}, Sinusoid{.amplitude = A * (1.0 + excess), .frequency = 1.0, .phase = std::numbers::pi}}};
      const auto r =
          run(drive(table1(), constant(0.0), motor), Timetable(0, 0.9, never), {0, {0, 50.0}, {}}, tight(method));
      REQUIRE(r.modes() == std::vector{forward_left, forward_right, forward_left});
      const double early = std::acos(1.0 / (1.0 + excess)) / (2.0 * std::numbers::pi);
      REQUIRE(std::abs(r.events[0].after.t - (0.5 - early)) <= 1e-11);
      REQUIRE(std::abs(r.events[1].after.t - (0.5 + early)) <= 1e-11);
    }
}

TEST_CASE("a speed whose minima are flat to rounding is followed through them") {
  // The torque swings by 1e-9 N m around the one that holds the speed: at every extremum of the speed the acceleration
  // is exactly zero for longer than CVODE takes to look behind a root.
  const MeshParameters<double> p = table1();
  const Branch in(p, forward_left);
  const double load = 0.03, A = 1e-9;
  for (double frequency : {0.1, 1.0, 10.0})
    for (By method : every_solver) {
      const Signal motor{{Constant{-in.C * load}, Sinusoid{.amplitude = A, .frequency = frequency}}};
      const auto r =
          run(drive(p, constant(load), motor), Timetable(0, 20, 0.5), {0, {0, 1.0}, {}}, tight(method, 1e-10));
      REQUIRE(r.modes() == std::vector{forward_left});
      REQUIRE(std::abs(r.end.x[1] - 1.0) <= 1e-8);
    }
}

TEST_CASE("a torque that tops the break-in torque for less than a step of the search still releases the drive") {
  const MeshParameters<double> p = table1();
  const double load = 0.69, break_in = -GearMesh<double>(p).C1() * load;
  for (double excess : {1e-3, 1e-5, 1e-7, 1e-8}) {
    const auto r =
        run(drive(p, constant(load), peaks_at_half(break_in * (1.0 + excess))), Timetable(0, 0.9, never), {});
    REQUIRE(r.modes() == std::vector{stuck, forward_left, stuck});
    const double early = std::acos(1.0 / (1.0 + excess)) / (2.0 * std::numbers::pi);
    REQUIRE(std::abs(r.events[0].after.t - (0.5 - early)) <= 1e-11);
    REQUIRE(r.end.x[0] > 0.0);

    const auto held =
        run(drive(p, constant(load), peaks_at_half(break_in * (1.0 - excess))), Timetable(0, 3, never), {});
    REQUIRE(held.modes() == std::vector{stuck});
    REQUIRE(held.end.x[0] == 0.0);
  }
}

TEST_CASE("a torque that only touches the switching surface leaves the drive on the flank it had") {
  // Without load the surface is tau_m = 0, which 1 - cos touches once in a period. Rounding lets it be crossed there;
  // a drive that believes it would stay on the wrong flank, for the torque never becomes positive on the other side.
  for (double frequency : {0.01, 1.0, 25.0})
    for (double A : {1e-4, 0.7})
      for (int side : {1, -1})
        for (double reports_per_period : {4.0, 10.0, 1e-9})  // one of them on the very touch, or none
          for (By method : every_solver) {
            const Mode mode = side > 0 ? forward_left : forward_right;
            const Signal wave{{Constant{-side * A}, Sinusoid{.amplitude = side * A, .frequency = frequency}}};
            const double begin = 0.3 / frequency, end = 5.5 / frequency, omega = 2.0 * std::numbers::pi * frequency;
            const double push = -side * A / Branch(table1(), mode).M, start = 20.0 + std::abs(push) * end;
            const auto r =
                run(drive(table1(), constant(0.0), wave), Timetable(begin, end, 1.0 / (frequency * reports_per_period)),
                    {begin, {0, start}, {}}, tight(method, 1e-10));
            REQUIRE(r.modes() == std::vector{mode});
            const double gained = push * (end - begin - (std::sin(omega * end) - std::sin(omega * begin)) / omega);
            REQUIRE(std::abs(r.end.x[1] - start - gained) <= 1e-7 * start);
          }
}

TEST_CASE(
    "a torque that touches the switching surface on the very knot where it turns back changes no flank for good") {
  const Branch in(table1(), forward_left);
  const Signal roof{{Constant{-0.03125}, Ramp{.rate = 0.0625, .end = 0.5}, Ramp{.rate = -0.0625, .start = 0.5}}};
  const auto r = run(drive(table1(), constant(0.0), roof), Timetable(0, 1, never), {0, {0, 50.0}, {}});
  REQUIRE(r.rows.front().now.mode == forward_left);
  REQUIRE(r.end.mode == forward_left);
  for (const auto& event : r.events) REQUIRE(event.after.t == 0.5);
  REQUIRE(std::abs(r.end.x[1] - (50.0 - 2.0 * 0.03125 * 0.25 / in.M)) <= 1e-9);
}

}  // namespace wormdrive::test::events_grazing
