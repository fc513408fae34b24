// What generality costs: fig. 9 of the paper, open loop, by wormdrive with CVODE and by a plain CVODE program written
// for this case alone. Both use the same SUNDIALS, method and tolerances and store the same rows.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <numbers>
#include <string>
#include <vector>

#include <alloca.h>
#include <fmt/format.h>
#include <sundials/sundials_version.h>

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
constexpr int expected_events = 12;
constexpr int warm_up = 3;  ///< runs that are not timed

Run by_wormdrive(const Settings& settings) {
  const MeshParameters<double> table_1{.i = 60,
                                       .lambda = 4 * unit::degree,
                                       .phi_n = 20 * unit::degree,
                                       .lw = 0.011,
                                       .lg = 0.045,
                                       .mu = 0.25,
                                       .Jw = 2.53e-5,
                                       .Jg = 7.39e-4};
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

  /// How stack and heap lie to each other can change the time by more than what is compared here: the k-th run shifts
  /// the stack, so that the median is over layouts and not that of the one which this process happens to have.
  void repeat(const Settings& settings, int k) {
    constexpr int page = 4096, shift = 65 * 16;  // visits every multiple of 16 in a page
    volatile char* room = static_cast<char*>(alloca(1 + std::abs(k) * shift % page));
    room[0] = 0;
    const double start = cpu_time();
    run = simulate(settings);
    if (k >= 0) times.push_back(cpu_time() - start);
  }
  double median() const {
    std::vector<double> sorted = times;
    const auto middle = sorted.begin() + std::ssize(sorted) / 2;
    std::nth_element(sorted.begin(), middle, sorted.end());
    return *middle;
  }
  /// Just before and just after an event are two rows of one time.
  int events() const {
    int n = 0;
    for (std::size_t k = 1; k < run.rows.size(); ++k) n += run.rows[k].t == run.rows[k - 1].t;
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

constexpr auto row_format = "{:<9}  {:<6}  {:<5}  {:>13}  {:>5}  {:>16}  {:>6}  {:>11}  {:>13}  {:>11}  {:>5}\n";

void print_row(const Contestant& program, const Settings& settings, const std::string& apart,
               const std::string& ratio) {
  const Row& end = program.run.rows.back();
  fmt::print(row_format, program.name, settings.bdf ? "BDF" : "Adams",
             fmt::format("{:.0e}", settings.relative_tolerance), fmt::format("{:.1f}", 1e6 * program.median()),
             program.run.steps, program.run.evaluations, program.events(),
             fmt::format("{:.1e}", end.theta_g - reference_angle), fmt::format("{:.1e}", end.omega_g - reference_speed),
             apart, ratio);
}

/// Runs both programs in turn, so that a change in the machine's speed meets both, and prints their two rows.
/// Returns whether they did the same work.
bool compare(const Settings& settings, int repetitions) {
  Contestant hand{"by hand", by_hand}, ours{"wormdrive", by_wormdrive};
  for (int k = -warm_up; k < repetitions; ++k) {
    hand.repeat(settings, k);
    ours.repeat(settings, k);
  }
  const std::vector<Row>&a = hand.run.rows, &b = ours.run.rows;
  double apart = 0.0;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
    apart = std::max(apart, std::abs(a[k].theta_g - b[k].theta_g));
  print_row(hand, settings, "", "");
  print_row(ours, settings, fmt::format("{:.1e}", apart), fmt::format("{:.3f}", ours.median() / hand.median()));
  return a.size() == b.size() && hand.events() == expected_events && ours.events() == expected_events;
}

int run(int repetitions) {
#ifndef NDEBUG
  fmt::print("not a release build: the times say nothing\n");
#endif
  char version[32];
  SUNDIALSGetVersion(version, sizeof version);
  fmt::print("fig. 9 for {} s with {} outputs, SUNDIALS {}, median of {} runs each\n", end_time, outputs, version,
             repetitions);
  fmt::print(row_format, "program", "method", "rtol", "CPU time [us]", "steps", "right-hand sides", "events",
             "error [rad]", "error [rad/s]", "apart [rad]", "ratio");
  bool comparable = true;
  for (const bool bdf : {true, false})
    for (const double tolerance : {1e-8, 1e-10, 1e-12})
      comparable = compare({bdf, tolerance, tolerance / 100}, repetitions) && comparable;
  if (!comparable) fmt::print("no comparison: rows or events are missing in one of the programs\n");
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
