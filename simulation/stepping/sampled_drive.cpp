#include "simulation/stepping/sampled_drive.hpp"

#include <algorithm>
#include <utility>

#include "events/simulate.hpp"
#include "events/taylor/solver.hpp"

namespace wormdrive {

struct SampledDrive::Solver {
  TaylorSolver<Drive> taylor;
};

SampledDrive::SampledDrive(Drive drive, double tolerance)
    : drive_(std::move(drive)),
      solver_(new Solver{
          {drive_,
           {.solver = SolverKind::taylor, .relative_tolerance = tolerance, .absolute_tolerance = 0.01 * tolerance}}}) {}
SampledDrive::~SampledDrive() = default;

void SampledDrive::run(Instant& now, double end, int most_events) {
  TaylorSolver<Drive>& solver = solver_->taylor;
  keep_between_stops(drive_.effects(), now.x[0]);
  const auto take_up = [&] {
    now.mode = settle(drive_, solver, now);
    solver.restart(now);
  };
  take_up();
  int events = 0;
  for (double knot = drive_.next_knot(now.t);;) {
    const double stop = std::min(end, knot);
    if (const int guard = solver.advance(now, stop, stop); guard != no_guard) {
      if (guard < Drive::guard_count) now = jump(drive_, solver, now, guard);
      solver.restart(now);
      if (++events > most_events) throw SolverFault("too many events within one sample");
      continue;
    }
    now.t = stop;
    if (stop == end) return;
    drive_.enter(stop);
    knot = drive_.next_knot(stop);
    take_up();
  }
}

}  // namespace wormdrive
