// How fast is fig. 9, open loop, at equal accuracy of the end state; and what does generality cost: wormdrive with
// CVODE against a plain CVODE program with the same settings and the same rows.
#include <cmath>
#include <memory>

#include <boost/numeric/odeint.hpp>

#include "bench/contest.hpp"
#include "bench/generality.hpp"
#include "bench/hybrid_by_hand.hpp"
#include "bench/odeint_by_hand.hpp"
#include "bench/reference.hpp"
#include "bench/sundials_by_hand.hpp"
#include "bench/worm_drive.hpp"
#include "events/cvode_solver.hpp"
#include "events/simulate.hpp"
#include "events/taylor/solver.hpp"

namespace bench {
namespace {

using namespace wormdrive;
using ByHand = Plant<open_loop, double>;

template <class Integrator>
Contender by_hand(const char* name) {
  using Loop = HybridByHand<ByHand, Integrator>;
  return {name, [](double tolerance) {
            const auto loop = std::make_shared<Loop>(tolerance);
            const auto run = [loop] {
              loop->begin();
              loop->hold(0.0, end_time);
              loop->advance(end_time, end_time);
              return Outcome{loop->y()[0], loop->y()[1], loop->evaluations(), loop->events()};
            };
            return Prepared{run, run};
          }};
}

template <template <class> class Solver>
Contender by_wormdrive(const char* name, Method method) {
  struct Program {
    Drive drive = drive_of(open_loop);
    Solver<Drive> solver;
    Program(Method m, double tolerance) : solver(drive, settings(m, tolerance)) {}
  };
  return {name, [method](double tolerance) {
            const auto program = std::make_shared<Program>(method, tolerance);
            const auto run = [program] {
              auto& [drive, solver] = *program;
              const long before = solver.statistics().evaluations;
              int sides = 0;
              const auto end = simulate(drive, solver, Timetable(0.0, end_time, never), Drive::Instant{},
                                        [&](const Drive&, const Drive::Instant&) { ++sides; });
              // every event has two sides, the beginning and the end have one each
              return Outcome{end.x[0], end.x[1], solver.statistics().evaluations - before, sides / 2 - 1};
            };
            return Prepared{run, run};
          }};
}

Outcome reference() {
  InQuad<open_loop, 24> run(1e-3);
  run.begin();
  run.hold(0.0, Quad(end_time));
  run.advance(Quad(end_time), Quad(end_time));
  return {static_cast<double>(run.y()[0]), static_cast<double>(run.y()[1]), run.evaluations(), run.events()};
}

}  // namespace
}  // namespace bench

int main(int argc, char** argv) {
  using namespace bench;
  const Options chosen = options(argc, argv);
  hold({"fig. 9, open loop, 2 s",
        1e-6,
        "us",
        reference(),
        {by_hand<CvodeByHand<ByHand, false>>("CVODE Adams by hand"),
         by_hand<CvodeByHand<ByHand, true>>("CVODE BDF by hand"), by_hand<ErkstepByHand<ByHand, 5>>("ERKStep by hand"),
         by_hand<OdeintByHand<ByHand, boost::numeric::odeint::runge_kutta_dopri5>>("odeint dopri5 by hand"),
         by_hand<OdeintByHand<ByHand, boost::numeric::odeint::runge_kutta_fehlberg78>>("odeint fehlberg78 by hand"),
         by_wormdrive<CvodeSolver>("cvode Adams", Method::adams), by_wormdrive<CvodeSolver>("cvode BDF", Method::bdf),
         by_wormdrive<TaylorSolver>("taylor", Method::adams)}},
       chosen);
  compare_generality(chosen);
}
