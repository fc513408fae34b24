#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "compliant_drives.hpp"
#include "core/elastic/compliant_start.hpp"
#include "events/audit.hpp"

// The audit of drives with elastic teeth.

namespace wormdrive::test::events_audit_compliant {

namespace {

using Drive = ElasticDrive;
using Trail = AuditTrail<Drive, CvodeSolver<Drive>>;

/// Fig. 9 with impacts and bearings, of a geometry that closes, with the record that an audit reads.
struct Fig9 {
  Drive system =
      compliant(closing(table1()), fig9_load(), fig9_motor(), {HuntCrossley<double>{1e6, 300.0}, 0.02 * unit::degree},
                effects(WormCoulomb<double>{1e-3}, GearCoulomb<double>{1e-3}));
  CvodeSolver<Drive> solver{system, tight(bdf, 1e-12)};
  Trail trail{solver};

  Fig9() {
    system.enter(0.0);
    simulate(system, solver, Timetable(0, 1, 0.002), {0.0, carrying(system, 0.0, 0.0, 0.0), {}}, trail);
  }
  AuditReport report() { return Audit<Drive>(system).examine(trail); }
};

}  // namespace

TEST_CASE("the audit of fig. 9 with impacts confirms every event, misses none, and its energy closes") {
  Fig9 run;
  long events = 0;
  for (std::size_t n = 1; n < run.trail.entries.size(); ++n)
    events += run.trail.entries[n].now.mode != run.trail.entries[n - 1].now.mode;
  const AuditReport report = run.report();
  INFO(events << " events, " << report.findings.size() << " findings, times " << report.largest_time_error
              << " s, energy " << report.energy_error << " of " << report.work << " J");
  REQUIRE(events >= 20);
  REQUIRE(report.events == events);
  REQUIRE(report.findings.empty());
  REQUIRE(report.largest_time_error <= 1e-8);
  REQUIRE(report.largest_angle_error <= 1e-8);
  REQUIRE(report.largest_speed_error <= 1e-5);
  REQUIRE(std::abs(report.energy_error) <= 1e-11 * report.work);
}

TEST_CASE("an impact that a run passed over, and an opening, are found with their time and guard") {
  for (const bool impact : {true, false}) {
    Fig9 run;
    auto& entries = run.trail.entries;
    std::size_t from = 1;
    while (entries[from].now.t < 0.3 || entries[from].now.mode == entries[from - 1].now.mode ||
           (entries[from].now.mode.contact != Flank::none) != impact)
      ++from;
    const double time = entries[from].now.t;
    std::size_t to = from + 1;
    while (entries[to].now.mode == entries[from].now.mode) ++to;
    const CompliantMode passed = entries[from - 1].now.mode;
    for (std::size_t n = from; n < to; ++n) entries[n].now.mode = passed;
    entries.erase(entries.begin() + static_cast<std::ptrdiff_t>(from));  // its right limit
    const AuditReport report = run.report();
    const auto missed =
        std::find_if(report.findings.begin(), report.findings.end(), [](const auto& f) { return f.missed; });
    REQUIRE(missed != report.findings.end());
    REQUIRE(missed->guard == (impact ? "right gap" : "normal force"));
    REQUIRE(std::abs(missed->t - time) <= 1e-6);
  }
}

}  // namespace wormdrive::test::events_audit_compliant
