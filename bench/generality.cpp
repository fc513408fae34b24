#include "bench/generality.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <fmt/format.h>

#include "bench/hybrid_by_hand.hpp"
#include "bench/sundials_by_hand.hpp"
#include "bench/worm_drive.hpp"
#include "events/cvode_solver.hpp"
#include "events/simulate.hpp"

namespace bench {
namespace {

using namespace wormdrive;

constexpr int outputs = 1000;
constexpr double interval = end_time / outputs;  ///< of the outputs; besides, both sides of every event are rows

/// One row, in SI; motion +1 forward, -1 backward, 0 stuck; flank +1 left, -1 right, 0 while stuck.
struct Row {
  double t, theta_g, omega_g, alpha_g, tau_m, tau_l, normal_force;
  int motion, flank;
};

/// A program that leaves its rows behind.
struct Program {
  std::vector<Row> rows;
  std::function<long()> run;  ///< returns its evaluations
  Timing timing{};
  long evaluations = 0;
};

template <bool bdf>
void plain(Program& program, double tolerance) {
  using ByHand = Plant<open_loop, double>;
  using Loop = HybridByHand<ByHand, CvodeByHand<ByHand, bdf>>;
  const auto loop = std::make_shared<Loop>(tolerance);
  program.run = [&rows = program.rows, loop] {
    rows.clear();
    const auto store = [&](const Loop& now) {
      const ByHand& plant = now.plant();
      const double theta = now.y()[0], tau_m = plant.motor_torque(now.t()), tau_l = plant.load_torque(theta);
      const double alpha = plant.acceleration(plant.mode, tau_m, tau_l);
      rows.push_back({now.t(), theta, now.y()[1], alpha, tau_m, tau_l, plant.normal_force(tau_m, tau_l, alpha),
                      motion(plant.mode), flank(plant.mode)});
    };
    loop->begin();
    loop->hold(0.0, end_time);
    store(*loop);
    for (int k = 1; k <= outputs; ++k) {
      loop->advance(k * interval, end_time, store);
      store(*loop);
    }
    return loop->evaluations();
  };
}

void general(Program& program, Method method, double tolerance) {
  struct Parts {
    Drive drive = drive_of(open_loop);
    CvodeSolver<Drive> solver;
    Parts(Method m, double eps) : solver(drive, settings(m, eps)) {}
  };
  const auto parts = std::make_shared<Parts>(method, tolerance);
  program.run = [&rows = program.rows, parts] {
    auto& [drive, solver] = *parts;
    rows.clear();
    const long before = solver.statistics().evaluations;
    simulate(drive, solver, Timetable(0.0, end_time, interval), Drive::Instant{},
             [&](const Drive&, const Drive::Instant& now) {
               const Observation seen = drive.observe(now);
               rows.push_back({now.t, seen.theta_g, seen.omega_g, seen.alpha_g, seen.tau_m, seen.tau_l,
                               seen.normal_force, sign(seen.mode.motion), sign(seen.mode.flank)});
             });
    return solver.statistics().evaluations - before;
  };
}

void measure(Program& program, int k) {
  const auto run = [&] {
    program.evaluations = program.run();
    return Outcome{};
  };
  program.timing.measure(run, k);
}

}  // namespace

void compare_generality(const Options& options) {
  const std::string title = "fig. 9 with 1000 outputs, wormdrive's cvode against plain CVODE";
  if (!options.rows)
    fmt::print(
        "\n{}\n\n| method | rtol | evaluations | events | largest difference [rad] | by hand [us] | cvode [us] | "
        "ratio |\n|---|---|---|---|---|---|---|---|\n",
        title);
  for (const Method method : {Method::bdf, Method::adams})
    for (const double tolerance : {1e-8, 1e-10, 1e-12}) {
      Program hand, ours;
      method == Method::bdf ? plain<true>(hand, tolerance) : plain<false>(hand, tolerance);
      general(ours, method, tolerance);
      for (int k = -1; k < options.repetitions; ++k) {  // in turn: a change in the machine's speed meets both
        measure(hand, k);
        measure(ours, k);
      }
      double apart = hand.rows.size() == ours.rows.size() ? 0.0 : never;
      for (std::size_t k = 0; k < std::min(hand.rows.size(), ours.rows.size()); ++k)
        apart = std::max(apart, std::abs(hand.rows[k].theta_g - ours.rows[k].theta_g));
      const auto events = (ours.rows.size() - outputs - 1) / 2;
      const char* const name = method == Method::bdf ? "BDF" : "Adams";
      const double by_hand = 1e6 * hand.timing.median(), by_us = 1e6 * ours.timing.median();
      if (options.rows)
        fmt::print("{}\tcvode / by hand\t{}\t{:.0e}\t{}\t{}\t{:.1e}\t{:.3f}\n", title, name, tolerance,
                   ours.evaluations, events, apart, by_us / by_hand);
      else
        fmt::print("| {} | {:.0e} | {} / {} | {} | {:.1e} | {:.1f} | {:.1f} | {:.3f} |\n", name, tolerance,
                   hand.evaluations, ours.evaluations, events, apart, by_hand, by_us, by_us / by_hand);
    }
}

}  // namespace bench
