// How fast is the closed loop of fig. 10 at equal accuracy: the sliding controller samples, its torque is held, events
// between samples are found. The controller is the code of control/ for every contender, the bare loop included.
#include "control/closed_loop.hpp"

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <boost/numeric/odeint.hpp>
#include <fmt/format.h>

#include "bench/bare_loop.hpp"
#include "bench/contest.hpp"
#include "bench/hybrid_by_hand.hpp"
#include "bench/odeint_by_hand.hpp"
#include "bench/reference.hpp"
#include "bench/sampled_loop.hpp"
#include "bench/sundials_by_hand.hpp"
#include "bench/worm_drive.hpp"
#include "control/sliding.hpp"
#include "events/cvode_solver.hpp"
#include "events/simulate.hpp"
#include "events/taylor/solver.hpp"

namespace bench {
namespace {

using namespace wormdrive;
using ByHand = Plant<closed_loop, double>;
struct Nobody {
  void operator()(const ControlRecord&) const {}
};
ClosedLoop<SlidingController, Nobody> controller(double period) { return bench::controller(period, Nobody{}); }

/// A program for this case alone.
template <class Loop>
Contender alone(const char* name, double period, const Torques& torques, bool adjustable = true) {
  return {name,
          [&torques, period](double tolerance) {
            const auto loop = std::make_shared<Loop>(tolerance);
            return Prepared{[=] {
                              run_sampled(*loop, period, controller(period));
                              return outcome(*loop);
                            },
                            [=, &torques] {
                              run_sampled(*loop, period, Replay{torques});
                              return outcome(*loop);
                            }};
          },
          adjustable};
}
template <class Plant, class Integrator>
Contender by_hand(const char* name, double period, const Torques& torques) {
  return alone<HybridByHand<Plant, Integrator>>(name, period, torques);
}

template <class Solver>
struct WithSolver {
  Drive drive;
  Solver solver;

  WithSolver(Drive driven, Method method, double tolerance)
      : drive(std::move(driven)), solver(drive, settings(method, tolerance)) {}

  template <class Controller, class Recorder>
  Outcome run(double period, Controller control, Recorder&& record) {
    const long before = solver.statistics().evaluations;
    const Timetable samples(0.0, duration, never, {period, 0.0});
    const auto end = simulate(drive, solver, control, samples, Drive::Instant{}, record);
    return {end.x[0], end.x[1], solver.statistics().evaluations - before, 0};
  }
  Outcome live(double period) {
    return run(period, controller(period), [](const auto&, const auto&) {});
  }
  Outcome replay(double period, const Torques& torques) {
    int events = 0;  // the mode changes while the torque does not
    double torque = 0.0;
    Drive::Instant last{};
    Outcome end = run(period, Replay{torques}, [&](const Drive& now_driven, const Drive::Instant& now) {
      const double held = now_driven.motor_piece().constant;
      events += held == torque && now.t == last.t && now.mode != last.mode;
      torque = held;
      last = now;
    });
    end.events = events;
    return end;
  }
};

template <template <class> class Solver>
Contender by_wormdrive(const char* name, const Drive& drive, Method method, double period, const Torques& torques) {
  return {name, [=, &torques](double tolerance) {
            const auto program = std::make_shared<WithSolver<Solver<Drive>>>(drive, method, tolerance);
            return Prepared{[=] { return program->live(period); },
                            [=, &torques] { return program->replay(period, torques); }};
          }};
}

/// The torques that the controller gives a drive without error, and where they lead.
template <class Run>
Outcome reference(Run& run, double period, Torques& torques) {
  struct Recording {
    decltype(controller(0.0)) control;
    Torques& torques;
    double sample(const Sensor& sensor, const Sensor::Instant& now) {
      return torques.emplace_back(control.sample(sensor, now));
    }
  };
  run_sampled(run, period, Recording{controller(period), torques});
  return outcome(run);
}

void contest(double period, const Options& chosen) {
  using namespace boost::numeric::odeint;
  const Drive drive = drive_of(closed_loop);
  Torques torques;
  InQuad<closed_loop, 14> quad(5e-4);
  const Outcome end = reference(quad, period, torques);
  const auto title = fmt::format("closed loop, {} s at {} kHz", duration, 1e-3 / period);
  hold({title,
        1e-9 * duration / period,
        "ns per sample",
        end,
        {by_hand<ByHand, CvodeByHand<ByHand, false>>("CVODE Adams by hand", period, torques),
         by_hand<ByHand, CvodeByHand<ByHand, true>>("CVODE BDF by hand", period, torques),
         by_hand<ByHand, ErkstepByHand<ByHand, 5>>("ERKStep by hand", period, torques),
         by_hand<ByHand, OdeintByHand<ByHand, runge_kutta_dopri5>>("odeint dopri5 by hand", period, torques),
         by_hand<ByHand, OdeintByHand<ByHand, runge_kutta_cash_karp54>>("odeint cash-karp by hand", period, torques),
         by_wormdrive<CvodeSolver>("cvode Adams", drive, Method::adams, period, torques),
         by_wormdrive<CvodeSolver>("cvode BDF", drive, Method::bdf, period, torques),
         by_wormdrive<TaylorSolver>("taylor", drive, Method::adams, period, torques),
         alone<BareLoop>("bare loop, no events", period, torques, false)}},
       chosen);
}

/// The same with friction of the teeth that falls with their speed, and bearings.
void contest_of_rubbing(double period, const Options& chosen) {
  using namespace boost::numeric::odeint;
  const Drive drive = drive_of(closed_loop, effects_of(rubbing));
  using Plant = RubbingPlant<closed_loop>;
  Torques torques;
  HybridByHand<Plant, OdeintByHand<Plant, runge_kutta_fehlberg78>> tight(1e-14);
  const Outcome end = reference(tight, period, torques);
  const auto title =
      fmt::format("closed loop with a Stribeck curve and bearings, {} s at {} kHz", duration, 1e-3 / period);
  hold({title,
        1e-9 * duration / period,
        "ns per sample",
        end,
        {by_hand<Plant, CvodeByHand<Plant, false>>("CVODE Adams by hand", period, torques),
         by_hand<Plant, ErkstepByHand<Plant, 5>>("ERKStep by hand", period, torques),
         by_hand<Plant, OdeintByHand<Plant, runge_kutta_dopri5>>("odeint dopri5 by hand", period, torques),
         by_wormdrive<CvodeSolver>("cvode Adams", drive, Method::adams, period, torques),
         by_wormdrive<TaylorSolver>("taylor", drive, Method::adams, period, torques)}},
       chosen);
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  const bench::Options chosen = bench::options(argc, argv);
  for (const double period : {1e-3, 1e-4}) bench::contest(period, chosen);
  bench::contest_of_rubbing(1e-3, chosen);
}
