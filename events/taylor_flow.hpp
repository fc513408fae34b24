#pragma once
#include <array>

#include "core/moment.hpp"
#include "events/taylor_accuracy.hpp"
#include "events/taylor_program.hpp"
#include "events/taylor_traced.hpp"

namespace wormdrive {

/// The motion of any drive as power series: its equations are traced once per mode and set of inputs into a program,
/// which is then propagated in every step. Where an equation takes a branch, as a table does at its points, the step
/// ends and the equations are traced anew.
template <class System>
class TracedFlow {
 public:
  using Instant = typename System::Instant;

  /// Takes up mode and inputs.
  void begin(const System& system, const Instant& now) {
    program_.clear();
    const auto ahead = system.template ahead<3>(now);
    const Moment<Traced> at = system.moment(Traced(program_, TaylorProgram::Operation::time, ahead.t),
                                            Traced(program_, TaylorProgram::Operation::angle, ahead.theta_g),
                                            Traced(program_, TaylorProgram::Operation::speed, ahead.omega_g));
    acceleration_ = system.acceleration(at, now.mode).result_in(program_);
    const auto guards = system.guards(at, now.mode);
    for (int g = 0; g < System::guard_count; ++g) guards_[g] = guards[g].result_in(program_);
    fresh_ = true;
    crossed_ = false;
  }

  /// The motion from now on, accurate over a step of at most h.
  void expand(const System& system, const Instant& now, double h, const TaylorAccuracy& accuracy,
              Expansion<System::guard_count>& e) {
    if (crossed_) begin(system, now);
    compute(now, h, accuracy, e);
    if (!fresh_ && left_branch()) {
      begin(system, now);
      compute(now, h, accuracy, e);
    }
    e.step = until_branch(e);
    fresh_ = false;
  }

 private:
  void compute(const Instant& now, double h, const TaylorAccuracy& accuracy, Expansion<System::guard_count>& e) {
    e.theta[0] = now.x[0];
    e.omega[0] = now.x[1];
    for (int k = 0;; ++k) {
      program_.propagate(k, now.t, e.theta, e.omega);
      for (int g = 0; g < System::guard_count; ++g) e.guards[g][k] = program_.coefficient(guards_[g], k);
      e.theta[k + 1] = e.omega[k] / (k + 1);
      e.order = k;
      if (k == accuracy.order || enough(h, accuracy, e)) break;
      e.omega[k + 1] = program_.coefficient(acceleration_, k) / (k + 1);
    }
    e.step = accuracy.step(e.speed(), h);
    for (int g = 0; g < System::guard_count; ++g) e.step = accuracy.step_of_guard(e.guard(g), e.step);
  }

  bool enough(double h, const TaylorAccuracy& accuracy, const Expansion<System::guard_count>& e) const {
    if (!accuracy.suffices(e.speed(), h)) return false;
    for (int g = 0; g < System::guard_count; ++g)
      if (accuracy.step_of_guard(e.guard(g), h) < h) return false;
    return true;
  }

  Coefficients distance(const TaylorProgram::Branch& branch, int order) const {
    Coefficients c;
    for (int k = 0; k <= order; ++k) c[k] = branch.sign * program_.coefficient(branch.result, k);
    return c;
  }

  /// Whether a step ended on the other side of a branch than the search for its crossing had it, by rounding.
  bool left_branch() const {
    for (const TaylorProgram::Branch& branch : program_.branches())
      if (branch.sign * program_.coefficient(branch.result, 0) <= 0.0) return true;
    return false;
  }

  /// The step up to which the branches taken are the right ones.
  double until_branch(const Expansion<System::guard_count>& e) {
    double step = e.step;
    for (const TaylorProgram::Branch& branch : program_.branches()) {
      const Coefficients c = distance(branch, e.order);
      const auto fall = search_.first_fall({c.data(), static_cast<std::size_t>(e.order) + 1}, step, !fresh_);
      if (!fall.at) continue;
      step = *fall.at;
      crossed_ = true;
    }
    return step;
  }

  TaylorProgram program_;
  RootSearch search_;
  int acceleration_ = -1;
  std::array<int, System::guard_count> guards_{};
  bool fresh_ = true;     ///< traced at the very instant at which the step begins
  bool crossed_ = false;  ///< the latest step ended at a branch
};

}  // namespace wormdrive
