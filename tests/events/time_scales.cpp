#include <cmath>
#include <limits>
#include <numbers>

#include "catch.hpp"
#include "core/ripple.hpp"
#include "events/audit.hpp"
#include "near_ties/dice.hpp"
#include "support.hpp"

// What decides at an event is the same on every time scale: the inputs' periods, the tolerance and the size of what is
// left over from rounding take no part in it.

namespace wormdrive::test::events_time_scales {

namespace {

constexpr double never = std::numeric_limits<double>::infinity(), day = 86400.0;
constexpr Mode forward_left{Motion::forward, Flank::left}, forward_right{Motion::forward, Flank::right}, stuck{};
constexpr double load = 0.2;

/// Whether no row of a run contradicts its mode.
template <class Run>
bool consistent(const Run& run) {
  for (const auto& row : run.rows)
    if (sign(row.now.mode.motion) * row.now.x[1] < 0.0 || row.seen.normal_force < -1e-9) return false;
  return true;
}

}  // namespace

TEST_CASE("a torque that touches break-in moves the gear for as long as it is above, whatever the period and excess") {
  const double break_in = -GearMesh<double>(table1()).C1() * load;
  near_ties::Dice dice(20261129, 2);
  for (double period : {1e-4, 1.0, day})
    for (double excess : {0.0, 2.3e-16, 1e-15, 1e-12, 1e-9, 1e-6, -1e-15, -1e-9})
      for (By method : every_solver)
        for (double tolerance : {1e-6, 1e-12}) {
          const Signal motor{{Sinusoid{
              .amplitude = break_in * (1.0 + excess), .frequency = 1.0 / period, .phase = -std::numbers::pi / 2}}};
          const auto runs = [&](double report) {
            return run(drive(table1(), constant(load), motor), Timetable(0, 2 * period, report), {},
                       tight(method, tolerance));
          };
          const auto r = runs(period / 3);
          const auto other = runs(dice.chance(0.5) ? never : period * dice.decades(1e-3, 1.0));
          REQUIRE(other.modes() == r.modes());  // who looks when decides nothing
          if (method.solver == SolverKind::taylor) REQUIRE(other.end.x == r.end.x);
          REQUIRE(consistent(r));
          REQUIRE(r.end.mode == stuck);
          REQUIRE(r.end.x[1] == 0.0);
          if (std::abs(excess) < 1e-15) continue;  // rounding decides whether it is touched or crossed
          REQUIRE(r.modes() ==
                  (excess > 0.0 ? std::vector{stuck, forward_left, stuck, forward_left, stuck} : std::vector{stuck}));
          if (excess <= 0.0 || tolerance > 1e-12) continue;
          // the torque is above for as long on both sides of its peak, and the gear takes as long again to stop
          const double above = std::sqrt(2.0 * excess) / (2.0 * std::numbers::pi) * period;
          const double slack = 0.02 * above + 1e-7 * period * std::sqrt(1e-16 / excess);
          REQUIRE(std::abs(r.events[0].after.t - (0.25 * period - above)) <= slack + 1e-14 * period);
          // it comes to rest where its speed, known to the absolute tolerance, falls as the torque lets it
          const double omega = 2.0 * std::numbers::pi / period;
          const double slowing = 1.5 * break_in / Branch(table1(), forward_left).M * omega * omega * above * above;
          const double late = 2.0 * slack + 3.0 * tight(method, tolerance).absolute_tolerance / slowing;
          REQUIRE(std::abs(r.events[1].after.t - (0.25 * period + 2.0 * above)) <= late + 1e-14 * period);
        }
}

TEST_CASE("a load that touches break-in does so for every solver") {
  const double C1 = GearMesh<double>(table1()).C1(), torque = -C1 * 0.2;
  for (double excess : {2e-13, 1e-9})
    for (By method : every_solver) {
      // the load falls to 0.2 (1 - excess) at t = 0.5: what the motor lifts rises above it
      const Signal lifted{{Constant{0.3}, Sinusoid{.amplitude = 0.1 + 0.2 * excess, .frequency = 1.0}}};
      const auto r = run(drive(table1(), lifted, constant(torque)), Timetable(0, 2, never), {}, tight(method, 1e-10));
      REQUIRE(consistent(r));
      REQUIRE(r.modes() == std::vector{stuck, forward_left, stuck, forward_left, stuck});
    }
}

TEST_CASE("a nanonewton-metre with a period of a day does not turn round what a pulse of a millisecond does") {
  const Signal pulse{{Step{.torque = 0.1, .time = 1.0}, Ramp{.rate = -100.0, .start = 1.0, .end = 1.001}}};
  const auto alone = run(drive(table1(), constant(load), pulse), Timetable(0, 2, never), {});
  REQUIRE(alone.modes() == std::vector{stuck, forward_left, stuck});
  for (double period : {1.0, day, 1e7})
    for (By method : every_solver) {
      const Signal slow{{Constant{load}, Sinusoid{.amplitude = 1e-9, .frequency = 1.0 / period}}};
      const auto r = run(drive(table1(), slow, pulse), Timetable(0, 2, never), {}, tight(method));
      REQUIRE(r.modes() == alone.modes());
      REQUIRE(std::abs(r.events[1].after.t - alone.events[1].after.t) <= 1e-9);
      REQUIRE(std::abs(r.end.x[0] - alone.end.x[0]) <= 1e-12);
    }
}

TEST_CASE("a flank change within a millisecond of the break-away is seen beside a torque of a day") {
  MeshParameters<double> p = table1();
  p.Jw = 1e-6;
  for (double period : {1.0, day, 1e7})
    for (By method : {bdf, taylor}) {
      const Signal motor{{Step{.torque = 0.1, .time = 1.0}, Sinusoid{.amplitude = 1e-6, .frequency = 1.0 / period}}};
      const auto r = run(drive(p, constant(load), motor, effects(WormViscous<double>{3e-3})), Timetable(0, 1.1, never),
                         {}, tight(method, 1e-10));
      REQUIRE(r.modes() == std::vector{stuck, forward_right, forward_left});
      REQUIRE(std::abs(r.events[1].after.t - 1.000856) <= 1e-6);
    }
}

TEST_CASE("friction that grows over hours holds no torque of ten times break-in") {
  for (double growth : {1e-4, 1.0, 1e4, 1e8})
    for (By method : every_solver) {
      const Signal motor{{Step{.torque = 0.1, .time = 1.0}}};
      const auto r = run(drive(table1(), constant(load), motor, effects(StaticFriction<double>{0.1, growth})),
                         Timetable(0, 1.2, never), {}, tight(method));
      REQUIRE(r.events.size() == 1);
      REQUIRE(r.events[0].after.t == 1.0);
      REQUIRE(r.end.mode.motion == Motion::forward);
    }
}

TEST_CASE("friction that grows at rest is watched until it has grown, and not while the gear moves") {
  const auto d = drive(table1(), constant(load), constant(0.1), effects(StaticFriction<double>{0.1, 1e-6}));
  WormDrive<double, TimedLoad>::Instant now;
  CHECK(fastest_change(d, now) == 1e6);
  now.t = 1e-4;
  CHECK(fastest_change(d, now) == 0.0);
  now.since = 0.99e-4;  // at rest for a microsecond
  CHECK(fastest_change(d, now) == 1e6);
  now.mode.motion = Motion::forward;
  CHECK(fastest_change(d, now) == 0.0);
  for (const By by : every_solver)  // a day at rest, and a second of motion
    for (const double torque : {0.0, 0.1}) {
      const double end = torque == 0.0 ? 86400.0 : 1.0;
      const auto count = [&](double growth) {
        const auto grown = effects(StaticFriction<double>{0.1, growth});
        return run(drive(table1(), constant(load), constant(torque), grown), Timetable(0, end, end), {}, tight(by))
            .statistics.evaluations;
      };
      CHECK(count(1e-6) <= 2 * count(1.0));
    }
}

TEST_CASE("a loose tolerance costs accuracy and no events", "[slow]") {
  Signal dithered = fig9_motor();
  dithered.terms.push_back(Sinusoid{.amplitude = 0.02, .frequency = 100.0});
  const auto exact = run(drive(table1(), fig9_load(), dithered), Timetable(0, 2, never), {}, tight(taylor));
  for (By method : every_solver)
    for (double tolerance : {1e-2, 1e-4, 1e-8}) {
      auto d = drive(table1(), fig9_load(), dithered);
      with_solver(d, tight(method, tolerance), [&]<class Solver>(Solver& solver) {
        AuditTrail<decltype(d), Solver> trail{solver};
        simulate(d, solver, Timetable(0, 2, 0.01), {}, trail);
        std::size_t changes = 0;
        for (std::size_t k = 1; k < trail.entries.size(); ++k)
          changes += trail.entries[k].now.mode == trail.entries[k - 1].now.mode ? 0 : 1;
        REQUIRE(changes == exact.events.size());
        REQUIRE(Audit(d).examine(trail).missed() == 0);
      });
    }
}

TEST_CASE("a motion that asks for no short step does not blur the events of a load that it does not feel") {
  auto p = table1();
  p.mu = GearMesh<double>(p).mu_w();  // C1 = 0: moving backward on the right flank the gear feels the motor alone
  const GearMesh<double> mesh(p);
  const double surface = p.Jw * p.i / p.Jg, amplitude = 1e-6;
  for (double share : {-0.9, -0.3, 0.2, 0.7})
    for (double frequency : {1e-4, 1.0, 1e4})
      for (double tolerance : {1e-13, 1e-10, 1e-6}) {
        const Signal swinging{{Sinusoid{.amplitude = amplitude, .frequency = frequency}}};
        WormDrive d(mesh, make_load(swinging), Effects<double>{}, constant(share * surface * amplitude));
        WormDrive<double, TimedLoad>::Instant from;
        from.x = {0.0, -1e6 * amplitude / (p.Jg * frequency)};
        const double end = 10.0 / frequency;
        const auto r = run(d, Timetable(0, end, end), from, tight(taylor, tolerance));
        CAPTURE(share, frequency, tolerance);
        REQUIRE(r.events.size() == 20);
        for (std::size_t k = 0; k < r.events.size(); ++k) {
          const double turn = std::acos(share) / (2.0 * std::numbers::pi),
                       whole = std::floor(0.5 * static_cast<double>(k));
          const double exact = (k % 2 == 0 ? whole + turn : whole + 1.0 - turn) / frequency;
          REQUIRE(std::abs(r.events[k].after.t - exact) <= 1e-12 * end);
        }
      }
}

TEST_CASE("power series cost no more where less is asked of them", "[slow]") {
  Signal dithered = fig9_motor();
  dithered.terms.push_back(Sinusoid{.amplitude = 0.02, .frequency = 100.0});
  const auto evaluations = [](const Signal& motor, const Effects<double>& on, double tolerance) {
    return run(drive(table1(), fig9_load(), motor, on), Timetable(0, 2, never), {}, tight(taylor, tolerance))
        .statistics.evaluations;
  };
  for (const Signal& motor : {fig9_motor(), dithered})
    for (const auto& on : {effects(), effects(PositionFriction<double>{0.1, 1.0})}) {
      const long fine = evaluations(motor, on, 1e-13);
      for (double tolerance : {1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1e-1})
        REQUIRE(static_cast<double>(evaluations(motor, on, tolerance)) <= 1.2 * static_cast<double>(fine));
    }
}

TEST_CASE("torques that change with the angle bound the steps of every solver, whatever the tolerance") {
  constexpr double pi = std::numbers::pi;
  auto p = table1();
  p.mu = 0.0;
  for (const double periods : {1.0, 7.0, 24.0})
    for (const double speed : {0.5, 30.0, -400.0}) {
      // the torque changes its sign, and with it the flank that carries the load, at every half period of the worm
      const double waves = p.i * periods, turns = 100.0 / waves, end = turns * 2.0 * pi / std::abs(speed);
      const Cogging<double> cogging{.amplitude = 1e-9 * speed * speed, .periods = periods, .phase = 0.3};
      for (const By method : every_solver)
        for (const double tolerance : {1e-2, 1e-5, 1e-9}) {
          INFO(periods << " periods, " << speed << " rad/s, tolerance " << tolerance);
          auto of = drive(p, constant(0.0), constant(0.0), effects(cogging));
          of.enter(0.0);
          const TimedDrive::Instant start{0.0, {0.0, speed}, {}};
          const auto r = run(std::move(of), Timetable(0, end, end), start, tight(method, tolerance));
          const double passed = std::abs(std::floor((waves * r.end.x[0] + 0.3) / pi) - std::floor(0.3 / pi));
          CHECK(passed >= 199.0);
          CHECK(static_cast<double>(r.events.size()) == passed);
        }
    }
}

}  // namespace wormdrive::test::events_time_scales
