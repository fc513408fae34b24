// How fast is a sweep of the closed loop of fig. 10, metrics and the monitor of Lemma 1 included: trials one after the
// other and in the lanes of one register, against programs for this drive alone and the loop without events.
#include <memory>
#include <random>
#include <vector>

#include <fmt/format.h>

#include "bench/bare_loop.hpp"
#include "bench/contest.hpp"
#include "bench/hybrid_by_hand.hpp"
#include "bench/reference.hpp"
#include "bench/sampled_loop.hpp"
#include "bench/sundials_by_hand.hpp"
#include "control/control_summary.hpp"
#include "control/lanes/batch.hpp"
#include "core/rigid_drive.hpp"
#include "simulation/run_batch.hpp"

namespace bench {
namespace {

using namespace wormdrive;
using ByHand = Plant<closed_loop, double>;

constexpr double period = 1e-3;  ///< [s]
constexpr int trials = LaneBatch::most;

ControlWatch watch() { return {MetricsWindow{}, fig_10, lemma1(believed(), Variations{})}; }

/// The first trial is fig. 10, in the others friction, load and inertia vary by a tenth.
std::vector<Scenario> scenarios(double tolerance) {
  const GearMesh<double> mesh = table_1();
  GravityArm arm;
  arm.amplitude = closed_loop.load_sine;
  arm.offset = -pi / 2;
  const NominalModel nominal = believed();
  Scenario first;
  first.mesh = stated(mesh);
  first.load = arm;
  first.run = {.duration = duration,
               .relative_tolerance = tolerance,
               .absolute_tolerance = absolute_part * tolerance,
               .solver = SolverKind::taylor};
  first.control = ControlScenario{.law = fig_10,
                                  .sampling = {.period = period},
                                  .anti_windup = {},
                                  .nominal = {.C1 = nominal.C1,
                                              .C2 = nominal.C2,
                                              .Jw_i = nominal.Jw_i,
                                              .Jg = nominal.Jg,
                                              .load_torque = nominal.load_torque,
                                              .load_angle_offset = 0.0,
                                              .load_constant = 0.0},
                                  .variations = {},
                                  .reference = {{SinusoidReference{.amplitude = 0.14, .frequency = 2.0}}},
                                  .sensor = {.filter_cutoff = 200.0},
                                  .disturbance = {},
                                  .window = {}};
  std::vector<Scenario> all(trials, first);
  std::mt19937_64 random(1);
  const auto vary = [&](double& x) { x *= std::uniform_real_distribution(0.9, 1.1)(random); };
  for (int k = 1; k < trials; ++k) {
    auto& varied = std::get<MeshParameters<double>>(all[k].mesh);
    for (double* number : {&varied.mu, &varied.Jw, &varied.Jg, &*std::get<GravityArm>(all[k].load).amplitude})
      vary(*number);
  }
  return all;
}

Outcome outcome_of(const RunSummary& first) {
  return {first.end.theta_g, first.end.omega_g, first.statistics.evaluations, static_cast<int>(first.total_events())};
}

/// A program for the first trial alone, as often as there are trials.
template <class Loop>
Contender alone(const char* name, bool adjustable = true) {
  return {name,
          [](double tolerance) {
            const auto loop = std::make_shared<Loop>(tolerance);
            const auto run = [=](int times) {
              for (int k = 0; k < times; ++k) {
                ControlWatch seen = watch();
                run_sampled(*loop, period, controller(period, [&](const ControlRecord& r) { seen.sample(r); }));
              }
              return outcome(*loop);
            };
            return Prepared{[=] { return run(trials); }, [=] { return run(1); }};
          },
          adjustable};
}

Contender one_by_one() {
  return {"taylor", [](double tolerance) {
            const auto all = std::make_shared<std::vector<Scenario>>(scenarios(tolerance));
            return Prepared{[=] {
                              Outcome first{};
                              for (const Scenario& scenario : *all) first = outcome_of(run_scenario(scenario));
                              return first;
                            },
                            [=] { return outcome_of(run_scenario(all->front())); }};
          }};
}

Contender in_lanes(LaneKind kind) {
  return {fmt::format("taylor, {} lanes", lanes_of(kind)), [kind](double tolerance) {
            const auto all = std::make_shared<std::vector<Scenario>>(scenarios(tolerance));
            const auto run = [=] { return outcome_of(std::get<RunSummary>(run_batch(*all, kind).front())); };
            return Prepared{run, run};
          }};
}

/// Where the controller leads a drive without error.
Outcome reference() {
  InQuad<closed_loop, 14> quad(5e-4);
  run_sampled(quad, period, controller(period, [](const ControlRecord&) {}));
  return outcome(quad);
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  using namespace bench;
  Contest contest{fmt::format("sweep of the closed loop, {} s at {} kHz, metrics and monitor", duration, 1e-3 / period),
                  1e-9 * trials * duration / period,
                  "ns per sample of a trial",
                  reference(),
                  {alone<HybridByHand<ByHand, CvodeByHand<ByHand, false>>>("CVODE Adams by hand"),
                   alone<HybridByHand<ByHand, ErkstepByHand<ByHand, 5>>>("ERKStep by hand"),
                   alone<BareLoop>("bare loop, no events", false), one_by_one()}};
  for (const LaneKind kind : lane_kinds)
    if (is_available(kind)) contest.contenders.push_back(in_lanes(kind));
  hold(contest, options(argc, argv));
}
