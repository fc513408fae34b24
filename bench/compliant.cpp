// What do elastic teeth cost: fig. 9 over 2 s with backlash and impacts against the rigid drive, both with cvode BDF at
// the tolerance that a scenario has if it states none.
#include <algorithm>
#include <cmath>
#include <concepts>
#include <utility>

#include <fmt/format.h>

#include "bench/contest.hpp"
#include "core/elastic/compliant_start.hpp"
#include "core/load.hpp"
#include "events/cvode_solver.hpp"
#include "events/simulate.hpp"

namespace bench {
namespace {

using namespace wormdrive;
using Rigid = WormDrive<double, GravityLoad>;
using Compliant = CompliantDrive<double, GravityLoad>;

constexpr double end_time = 2.0, tolerance = 1e-10, finest = 1e-14;

Rigid rigid() {
  constexpr MeshParameters<double> table_1{.i = 60,
                                           .lambda = 4 * unit::degree,
                                           .phi_n = 20 * unit::degree,
                                           .lw = 0.011,
                                           .lg = 0.045,
                                           .mu = 0.25,
                                           .Jw = 2.53e-5,
                                           .Jg = 7.39e-4};
  GravityArm arm;
  arm.amplitude = 0.0196;
  const Signal motor{{Sinusoid{.amplitude = 0.05, .frequency = 1.5, .phase = 90 * unit::degree}}};
  return Rigid(GearMesh<double>(table_1), make_load(arm), Effects<double>{}, motor);
}

/// Where a run ended, and what happened on the way.
struct End {
  Outcome outcome{};
  int impacts = 0;
};

/// A drive with its solver, set up once and run again and again.
template <class System>
class Program {
 public:
  Program(System system, typename System::Instant start, double relative_tolerance)
      : system_(std::move(system)),
        start_(start),
        solver_(system_, {.relative_tolerance = relative_tolerance, .absolute_tolerance = 0.01 * relative_tolerance}) {}

  End run() {
    const long before = solver_.statistics().evaluations;
    End end;
    Mode last{.flank = Flank::left};  // which the drive carries at the start
    int sides = 0;
    const auto stop = simulate(system_, solver_, Timetable(0.0, end_time, 2 * end_time), start_,
                               [&](const System&, const typename System::Instant& now) {
                                 const Mode mode = now.mode;
                                 ++sides;
                                 if constexpr (std::same_as<System, Compliant>)
                                   end.impacts += last.flank == Flank::none && mode.flank != Flank::none;
                                 last = mode;
                               });
    const auto at = system_.moment(stop);
    end.outcome = {at.theta_g, at.omega_g, solver_.statistics().evaluations - before, sides / 2 - 1};
    return end;
  }

 private:
  System system_;
  typename System::Instant start_;
  CvodeSolver<System> solver_;
};

Program<Rigid> rigid_program(double relative_tolerance) {
  return Program<Rigid>(rigid(), Rigid::Instant{}, relative_tolerance);
}
Program<Compliant> compliant_program(double damping, double gap, double relative_tolerance) {
  const ToothContact<double> contact{HuntCrossley<double>{1e6, damping}, gap};
  Compliant drive(rigid(), contact);
  drive.enter(0.0);
  Compliant::Instant start;
  start.x = carrying(drive, 0.0, 0.0, 0.0);
  return Program<Compliant>(drive, start, relative_tolerance);
}

/// One line of the table; returns the median time [s].
template <class Make>
double line(const char* name, Make&& make, double unit, const Options& chosen) {
  auto program = make(tolerance);
  const End end = program.run(), fine = make(finest).run();
  Timing timing;
  for (int k = -1; k < chosen.repetitions; ++k) timing.measure([&] { return program.run().outcome; }, k);
  const double error = std::max(std::abs(end.outcome.theta - fine.outcome.theta),
                                std::abs(end.outcome.omega - fine.outcome.omega)),
               time = timing.median();
  fmt::print("| {} | {} | {} | {} | {:.1e} | {:.4g} | {:.1f} |\n", name, end.outcome.evaluations, end.outcome.events,
             end.impacts, error, 1e6 * time, unit > 0.0 ? time / unit : 1.0);
  return time;
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  using namespace bench;
  const Options chosen = options(argc, argv);
  fmt::print(
      "| fig. 9, 2 s, cvode BDF 1e-10 | evaluations | events | impacts | error | CPU time [us] | times rigid |\n");
  fmt::print("|---|---|---|---|---|---|---|\n");
  const double unit = line("rigid", rigid_program, 0.0, chosen);
  const double gap = 0.02 * wormdrive::unit::degree;
  line(
      "elastic, c = 1000 s/m", [&](double rtol) { return compliant_program(1000, gap, rtol); }, unit, chosen);
  line(
      "elastic, c = 150 s/m", [&](double rtol) { return compliant_program(150, gap, rtol); }, unit, chosen);
  line(
      "elastic, c = 10 s/m", [&](double rtol) { return compliant_program(10, gap, rtol); }, unit, chosen);
}
