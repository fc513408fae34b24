#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.hpp>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "events/cvode_handles.hpp"
#include "events/halt.hpp"
#include "events/solver_settings.hpp"
#include "events/timetable.hpp"

namespace wormdrive {

/// SUNDIALS CVODE with two root functions per guard: BDF with Newton and the exact Jacobian, or Adams with fixed point.
///
/// A guard that dips below zero and comes back within one step changes no sign at the step's ends. So the guard's rate
/// is watched too: on the way to the root of the rate, CVODE evaluates all root functions and finds the guard below
/// zero.
///
/// CVODE goes step by step, ahead of the reports that fall into a step; those are read off the step's polynomial, for
/// a call of CVODE and a look at the guards per report would cost more than the report.
template <class System>
class CvodeSolver {
 public:
  using Instant = typename System::Instant;
  using State = typename System::State;

  /// The system must outlive the solver; its inputs and parameters may change between restarts.
  CvodeSolver(const System& system, const SolverSettings& settings)
      : system_(system), max_step_(settings.max_step), y_(N_VNew_Serial(System::state_size, context_)) {
    memory_.reset(CVodeCreate(settings.method == Method::bdf ? CV_BDF : CV_ADAMS, context_));
    if (!memory_ || !y_) throw std::bad_alloc();
    check_cvode(CVodeInit(memory(), right_hand_side, 0.0, y_.get()));
    check_cvode(CVodeSStolerances(memory(), settings.relative_tolerance, settings.absolute_tolerance));
    check_cvode(CVodeSetUserData(memory(), this));
    check_cvode(CVodeSetMaxNumSteps(memory(), max_steps));
    set_longest_step(max_step_);
    if (settings.method == Method::bdf) {
      matrix_.reset(SUNDenseMatrix(System::state_size, System::state_size, context_));
      linear_.reset(SUNLinSol_Dense(y_.get(), matrix_.get(), context_));
      check_cvode(CVodeSetLinearSolver(memory(), linear_.get(), matrix_.get()));
      check_cvode(CVodeSetJacFn(memory(), jacobian));
    } else {
      fixed_point_.reset(SUNNonlinSol_FixedPoint(y_.get(), 0, context_));
      check_cvode(CVodeSetNonlinearSolver(memory(), fixed_point_.get()));
    }
    check_cvode(CVodeRootInit(memory(), root_count, roots));
    std::array<int, root_count> directions;
    for (int k = 0; k < root_count; ++k) directions[k] = k < System::guard_count ? -1 : 1;  // guards fall, rates rise
    check_cvode(CVodeSetRootDirection(memory(), directions.data()));
    check_cvode(CVodeSetNoInactiveRootWarn(memory()));
    silence_cvode(context_, memory());
  }
  CvodeSolver(const CvodeSolver&) = delete;
  CvodeSolver& operator=(const CvodeSolver&) = delete;

  /// Takes up a new state; what the solver counted so far is kept, for CVODE forgets it here.
  void restart(const Instant& now) {
    total_ = statistics();
    ++total_.restarts;
    ahead_ = now;
    fired_ = no_guard;
    finite_ = true;
    state() = now.x;
    check_cvode(CVodeReInit(memory(), now.t, y_.get()));
    if constexpr (requires { system_.longest_step(now.mode); })
      set_longest_step(std::min(max_step_, system_.longest_step(now.mode)));
    limit_ = std::numeric_limits<double>::quiet_NaN();
  }

  /// Integrates to next (<= limit, past which nothing is evaluated); returns the guard that stopped it earlier, or
  /// no_guard.
  int advance(Instant& now, double next, double limit) {
    if (already_there(now.t, next)) {
      now.t = next;
      return no_guard;
    }
    if (limit != limit_) check_cvode(CVodeSetStopTime(memory(), limit_ = limit));
    for (long step = 0; ahead_.t < next && fired_ == no_guard; ++step) {
      const int flag = CVode(memory(), next, y_.get(), &ahead_.t, next < limit ? CV_ONE_STEP : CV_NORMAL);
      if (flag < 0 || step == max_steps) {
        now.t = ahead_.t;
        throw SolverFault(cvode_reason(flag >= 0 ? CV_TOO_MUCH_WORK : finite_ ? flag : CV_RHSFUNC_FAIL));
      }
      ahead_.x = state();
      if (flag == CV_ROOT_RETURN) fired_ = crossed();
    }
    if (ahead_.t <= next) {
      now = ahead_;
      return fired_;
    }
    now.t = next;
    now.x = state_at(next);
    return no_guard;
  }

  /// What the solver did since it was made.
  SolverStatistics statistics() const {
    SolverStatistics sum = total_;
    long steps = 0, evaluations = 0, jacobians = 0, failures = 0, roots = 0;
    check_cvode(CVodeGetNumSteps(memory(), &steps));
    check_cvode(CVodeGetNumRhsEvals(memory(), &evaluations));
    check_cvode(CVodeGetNumErrTestFails(memory(), &failures));
    check_cvode(CVodeGetNumGEvals(memory(), &roots));
    if (linear_) check_cvode(CVodeGetNumJacEvals(memory(), &jacobians));
    sum.steps += steps;
    sum.evaluations += evaluations;
    sum.jacobians += jacobians;
    sum.error_test_failures += failures;
    sum.guard_evaluations += roots;
    return sum;
  }

 private:
  static constexpr int root_count = 2 * System::guard_count;  ///< every guard and its rate
  static constexpr long max_steps = 10'000'000;  ///< between two stops; a stalled run fails earlier for its step size

  static int right_hand_side(sunrealtype t, N_Vector y, N_Vector ydot, void* self) {
    auto& solver = *static_cast<CvodeSolver*>(self);
    const State dx = solver.system_.derivative(t, Eigen::Map<const State>(N_VGetArrayPointer(y)), solver.ahead_.mode);
    Eigen::Map<State>(N_VGetArrayPointer(ydot)) = dx;
    // once is for good: the fixed-point iteration would only shorten its step and try again, without end
    solver.finite_ = solver.finite_ && dx.allFinite();
    return solver.finite_ ? 0 : -1;
  }
  static int jacobian(sunrealtype t, N_Vector y, N_Vector, SUNMatrix J, void* self, N_Vector, N_Vector, N_Vector) {
    const auto& solver = *static_cast<const CvodeSolver*>(self);
    Eigen::Map<typename System::Jacobian>(SUNDenseMatrix_Data(J)) =
        solver.system_.jacobian(t, Eigen::Map<const State>(N_VGetArrayPointer(y)), solver.ahead_.mode);
    return 0;
  }
  static int roots(sunrealtype t, N_Vector y, sunrealtype* values, void* self) {
    const auto& solver = *static_cast<const CvodeSolver*>(self);
    const auto g = solver.system_.guards_ahead({t, Eigen::Map<const State>(N_VGetArrayPointer(y)), solver.ahead_.mode});
    for (int k = 0; k < System::guard_count; ++k) {
      values[k] = g[k][0];
      // never exactly zero: CVODE gives up at a root function that stays zero behind its root, as slow rates do
      values[System::guard_count + k] = g[k][1] != 0.0 ? g[k][1] : std::numeric_limits<double>::min();
    }
    return 0;
  }

  /// The guard whose crossing CVODE stopped at; none at a minimum above zero.
  int crossed() const {
    std::array<int, root_count> found;
    check_cvode(CVodeGetRootInfo(memory(), found.data()));
    for (int k = 0; k < System::guard_count; ++k)
      if (found[k] != 0) return k;
    return no_guard;
  }

  void* memory() const { return memory_.get(); }
  Eigen::Map<State> state() { return Eigen::Map<State>(N_VGetArrayPointer(y_.get())); }
  /// At a time within the latest step.
  Eigen::Map<State> state_at(double t) {
    check_cvode(CVodeGetDky(memory(), t, 0, y_.get()));
    return state();
  }

  void set_longest_step(double step) { check_cvode(CVodeSetMaxStep(memory(), std::isfinite(step) ? step : 0.0)); }

  const System& system_;
  double max_step_;  ///< [s]
  sundials::Context context_;
  CvodeOwned<N_Vector> y_;
  CvodeOwned<SUNMatrix> matrix_;
  CvodeOwned<SUNLinearSolver> linear_;
  CvodeOwned<SUNNonlinearSolver> fixed_point_;
  CvodeMemory memory_;
  Instant ahead_{};       ///< how far CVODE has gone without a guard firing ...
  int fired_ = no_guard;  ///< ... or the guard that fired there
  bool finite_ = true;    ///< every acceleration since the latest restart was a number
  double limit_ = std::numeric_limits<double>::quiet_NaN();
  SolverStatistics total_{};
};

}  // namespace wormdrive
