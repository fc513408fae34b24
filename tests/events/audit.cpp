#include "events/audit.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include "catch.hpp"
#include "support.hpp"

// The audit against runs that are right, and against records of runs in which an event was taken out or put in.

namespace wormdrive::test::events_audit {

namespace {

using Drive = WormDrive<double, GravityLoad>;
using Trail = AuditTrail<Drive, CvodeSolver<Drive>>;

/// Fig. 9 with the record that an audit reads.
struct Fig9 {
  Drive system = drive(table1(), fig9_load(), fig9_motor());
  CvodeSolver<Drive> solver{system, tight(bdf, 1e-12)};
  Trail trail{solver};

  Fig9() { simulate(system, solver, Timetable(0, 2, 0.002), {}, trail); }

  AuditReport report() { return Audit<Drive>(system).examine(trail); }

  /// The first entry behind the k-th change of the mode, counted from 0.
  std::size_t behind_event(int k) const {
    for (std::size_t n = 1; n < trail.entries.size(); ++n)
      if (!(trail.entries[n].now.mode == trail.entries[n - 1].now.mode) && k-- == 0) return n;
    FAIL("there are fewer events");
    return 0;
  }
};

}  // namespace

TEST_CASE("the audit of fig. 9 confirms 12 events at 26 guards and misses none") {
  const AuditReport report = Fig9().report();
  REQUIRE(report.guards == 26);
  REQUIRE(report.events == 12);
  REQUIRE(report.findings.empty());
  REQUIRE(report.largest_time_error <= 1e-10);
  REQUIRE(report.largest_angle_error <= 1e-9);
  REQUIRE(report.largest_speed_error <= 1e-9);
}

TEST_CASE("an event that a run passed over is found with its time and guard") {
  for (const auto& [event, time, guard] :
       {std::tuple{1, 0.3612729976, "switching surface"}, {2, 0.5951950127, "gear speed"}}) {
    Fig9 run;
    const std::size_t from = run.behind_event(event), to = run.behind_event(event + 1);
    for (std::size_t n = from; n < to; ++n) run.trail.entries[n].now.mode = run.trail.entries[from - 1].now.mode;
    run.trail.entries.erase(run.trail.entries.begin() + static_cast<std::ptrdiff_t>(from));  // its right limit
    const AuditReport report = run.report();
    INFO(guard);
    REQUIRE(report.missed() == 1);
    const auto missed =
        std::find_if(report.findings.begin(), report.findings.end(), [](const auto& f) { return f.missed; });
    REQUIRE(missed->guard == guard);
    REQUIRE(std::abs(missed->t - time) <= 1e-8);
  }
}

TEST_CASE("an event where no guard falls through zero is not confirmed") {
  Fig9 run;
  const std::size_t at = run.behind_event(0) + 50, until = run.behind_event(1);
  auto entry = run.trail.entries[at];
  entry.now.mode.flank = Flank::right;
  run.trail.entries.insert(run.trail.entries.begin() + static_cast<std::ptrdiff_t>(at) + 1, entry);
  for (std::size_t n = at + 1; n <= until; ++n) run.trail.entries[n].now.mode.flank = Flank::right;
  const AuditReport report = run.report();
  REQUIRE(!report.findings.empty());
  REQUIRE(!report.findings.front().missed);
  REQUIRE(report.findings.front().t == entry.now.t);
}

TEST_CASE("the closest graze of the speed is its smallest minimum above zero") {
  // J theta'' = A cos(w t): theta' = v - A/(J w) + (A/(J w)) (1 + sin(w t)), lowest at w t = 3 pi/2.
  const double J = 0.02, A = 0.05, w = 2.0 * std::numbers::pi, left = 1e-6;
  const Signal motor{{Sinusoid{.amplitude = A, .frequency = 1.0, .phase = 0.0}}};
  auto system = WormDrive<double, TimedLoad>(GearMesh<double>::without_teeth(J), TimedLoad{}, {}, motor);
  CvodeSolver solver(system, tight());
  AuditTrail<decltype(system), decltype(solver)> trail{solver};
  decltype(system)::Instant start;
  start.x = {0.0, A / (J * w) + left};
  simulate(system, solver, Timetable(0, 1, 0.01), start, trail);
  const AuditReport report = Audit(system).examine(trail);
  REQUIRE(report.findings.empty());
  REQUIRE(report.closest.size() == 1);
  const Graze& speed = report.closest.at("gear speed");
  REQUIRE(std::abs(speed.t - 0.75) <= 1e-5);
  REQUIRE(std::abs(speed.distance - left) <= 1e-9);
}

TEST_CASE("the audit counts every time that a guard came and went without an event") {
  // speed = start - swing cos(2 pi t) from t = 0.25 on: below zero around t = 1, 2, ... 5, in a record without a stop
  const MeshParameters<double> p = table1();
  const Mode mode{Motion::forward, Flank::left};
  const Branch in(p, mode);
  const double held = 0.03, A = 1e-3, omega = 2.0 * std::numbers::pi, swing = A / (in.M * omega), start = 0.5 * swing;
  const Signal motor{
      {Constant{-in.C * held}, Sinusoid{.amplitude = A, .frequency = 1.0, .phase = -0.5 * std::numbers::pi}}};
  auto system = drive(p, constant(held), motor);
  struct Trace {
    struct Entry {
      decltype(system)::Instant now;
      long steps;
    };
    std::vector<Entry> entries;
  };
  const Trace trace{{{{0.25, {0.0, start}, mode, {}}, 0}, {{5.25, {0.0, start}, mode, {}}, 100}}};
  REQUIRE(Audit(system).examine(trace).missed() == 5);
}

TEST_CASE("the audit follows a gear that settles in a small share of the solver's steps") {
  for (const double rate : {1.0, 1e3, 1e5, 1e6}) {  // [1/s]
    constexpr double J = 0.02, amplitude = 3.0, frequency = 1.0;
    WormDrive system(GearMesh<double>::without_teeth(J), make_load(constant(0.0)),
                     effects(GearViscous<double>{J * rate}), Signal{{Sinusoid{amplitude, frequency}}});
    using System = decltype(system);
    CvodeSolver<System> solver(system, tight(bdf, 1e-10));
    AuditTrail<System, CvodeSolver<System>> trail{solver};
    simulate(system, solver, Timetable(0, 2, 0.01), {}, trail);
    const AuditReport report = Audit<System>(system).examine(trail);
    CAPTURE(rate, solver.statistics().steps);
    CHECK(report.events == 4);
    CHECK(report.findings.empty());
    const double swing = amplitude / (J * rate) / (2.0 * std::numbers::pi * frequency);
    CHECK(report.largest_angle_error <= 1e-8 * swing + 1e-10);
  }
}

TEST_CASE("an audit whose own integration comes to no number confirms nothing") {
  Fig9 run;
  run.trail.entries[run.behind_event(1)].now.x[1] = std::numeric_limits<double>::quiet_NaN();
  const AuditReport report = run.report();
  CHECK(report.events < 12);
  CHECK(std::isinf(report.largest_angle_error));
  CHECK(std::isinf(report.largest_speed_error));
}

}  // namespace wormdrive::test::events_audit
