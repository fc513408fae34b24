// What generality costs: fig. 9 of the paper, open loop, by wormdrive with CVODE and by a plain CVODE program written
// for this case alone. Both use the same SUNDIALS, method and tolerances and store the same rows.
#include <algorithm>
#include <alloca.h>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <fmt/format.h>
#include <numbers>
#include <vector>

#include "bench/open_loop.hpp"
#include "core/load.hpp"
#include "core/worm_drive.hpp"
#include "events/cvode_solver.hpp"
#include "events/simulate.hpp"

namespace bench {
namespace {

using namespace wormdrive;
using Drive = WormDrive<double, GravityLoad>;

// State at end_time, computed with 128-bit numbers.
constexpr double reference_angle = -5.4068889175374455, reference_speed = 1.0836146975023262;
constexpr std::size_t expected_events = 12;
constexpr int warm_up = 3;

Run by_wormdrive(const Settings& settings) {
  const MeshParameters<double> table_1{.i = 60, .lambda = 4 * unit::degree, .phi_n = 20 * unit::degree, .lw = 0.011,
                                       .lg = 0.045, .mu = 0.25, .Jw = 2.53e-5, .Jg = 7.39e-4};
  GravityArm arm;
  arm.amplitude = 0.0196;
  Drive drive(GearMesh<double>(table_1), make_load(arm), {}, Signal{{Sinusoid{0.05, 1.5, std::numbers::pi / 2}}});
  CvodeSolver<Drive> solver(drive, {.method = settings.bdf ? Method::bdf : Method::adams,
                                    .relative_tolerance = settings.relative_tolerance,
                                    .absolute_tolerance = settings.absolute_tolerance});
  Run run;
  run.rows.reserve(outputs + 100);
  simulate(drive, solver, Timetable(0.0, end_time, output_interval), Drive::Instant{},
           [&](const Drive&, const Drive::Instant& now) {
             const Observation seen = drive.observe(now);
             run.rows.push_back({now.t, seen.theta_g, seen.omega_g, seen.alpha_g, seen.tau_m, seen.tau_l,
                                 seen.normal_force, sign(seen.mode.motion), sign(seen.mode.flank)});
           });
  run.steps = solver.statistics().steps;
  run.evaluations = solver.statistics().evaluations;
  return run;
}

/// A program under test with the CPU times [s] of its runs.
struct Contestant {
  const char* name;
  Run (*simulate)(const Settings&);
  Run run{};
  std::vector<double> times{};

  /// Where stack and heap lie to each other changes the time by up to a fifth: every repetition shifts the stack, so
  /// that the median is one over layouts and not of the layout that this process happens to have.
  void repeat(const Settings& settings, int k) {
    volatile char* shift = static_cast<char*>(alloca(1 + k * 1040 % 4096));
    shift[0] = 0;
    const double start = cpu_time();
    run = simulate(settings);
    times.push_back(cpu_time() - start);
  }
  double median() const {
    std::vector<double> sorted = times;
    const auto middle = sorted.begin() + std::ssize(sorted) / 2;
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
  }
  std::size_t events() const {
    const auto same_time = [](const Row& a, const Row& b) { return a.t == b.t; };
    std::size_t n = 0;
    for (auto row = run.rows.begin(); (row = std::adjacent_find(row, run.rows.end(), same_time)) != run.rows.end(); ++row)
      ++n;
    return n;
  }

 private:
  /// Of the process, so that other programs on the machine do not count.
  static double cpu_time() {
    std::timespec now{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
  }
};

void print_row(const Contestant& program, const Settings& settings, const std::string& ratio) {
  const Row& end = program.run.rows.back();
  fmt::print("{:<10} {:<6} {:<6.0e} {:>13.1f} {:>6} {:>16} {:>7} {:>10.1e} {:>14.1e} {:>6}\n", program.name,
             settings.bdf ? "BDF" : "Adams", settings.relative_tolerance, 1e6 * program.median(), program.run.steps,
             program.run.evaluations, program.events(), end.theta_g - reference_angle, end.omega_g - reference_speed,
             ratio);
}

/// Runs both programs in turn, so that a change in the machine's speed meets both, and prints their two rows.
bool compare(const Settings& settings, int repetitions) {
  Contestant hand{"by hand", by_hand}, ours{"wormdrive", by_wormdrive};
  for (int k = 0; k < repetitions + warm_up; ++k) {
    if (k == warm_up) hand.times.clear(), ours.times.clear();
    hand.repeat(settings, k);
    ours.repeat(settings, k);
  }
  print_row(hand, settings, "");
  print_row(ours, settings, fmt::format("{:.3f}", ours.median() / hand.median()));
  return hand.events() == expected_events && ours.events() == expected_events &&
         hand.run.rows.size() == ours.run.rows.size();
}

int run(int repetitions) {
#ifndef NDEBUG
  fmt::print("not a release build: the times say nothing\n");
#endif
  char version[32];
  SUNDIALSGetVersion(version, sizeof version);
  fmt::print("fig. 9, {} s, {} outputs, SUNDIALS {}; median of {} repetitions\n", end_time, outputs, version, repetitions);
  fmt::print("{:<10} {:<6} {:<6} {:>13} {:>6} {:>16} {:>7} {:>10} {:>14} {:>6}\n", "program", "method", "rtol",
             "CPU time [us]", "steps", "right-hand sides", "events", "error [rad]", "error [rad/s]", "ratio");
  bool comparable = true;
  for (const bool bdf : {true, false})
    for (const double tolerance : {1e-8, 1e-10, 1e-12})
      comparable = compare({bdf, tolerance, tolerance / 100}, repetitions) && comparable;
  if (!comparable) fmt::print("the two programs did not do the same work: not a comparison\n");
  return comparable ? 0 : 1;
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  int repetitions = 51;
  if (argc == 3 && std::strcmp(argv[1], "--repetitions") == 0) repetitions = std::atoi(argv[2]);
  if (repetitions < 1 || (argc != 1 && argc != 3)) {
    fmt::print(stderr, "usage: {} [--repetitions N]\n", argv[0]);
    return 2;
  }
  return bench::run(repetitions);
}
