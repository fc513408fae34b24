#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.hpp>
#include <sundials/sundials_version.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "events/halt.hpp"
#include "events/solver_settings.hpp"
#include "events/timetable.hpp"

namespace wormdrive {

/// SUNDIALS CVODE with two root functions per guard: BDF with Newton and the exact Jacobian, or Adams with fixed point.
///
/// A guard that dips below zero and comes back within one step changes no sign at the step's ends. So the guard's rate
/// is watched too: on the way to the root of the rate, CVODE evaluates all root functions and finds the guard below zero.
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
    check(CVodeInit(memory(), right_hand_side, 0.0, y_.get()));
    check(CVodeSStolerances(memory(), settings.relative_tolerance, settings.absolute_tolerance));
    check(CVodeSetUserData(memory(), this));
    check(CVodeSetMaxNumSteps(memory(), max_steps));
    set_longest_step(max_step_);
    if (settings.method == Method::bdf) {
      matrix_.reset(SUNDenseMatrix(System::state_size, System::state_size, context_));
      linear_.reset(SUNLinSol_Dense(y_.get(), matrix_.get(), context_));
      check(CVodeSetLinearSolver(memory(), linear_.get(), matrix_.get()));
      check(CVodeSetJacFn(memory(), jacobian));
    } else {
      fixed_point_.reset(SUNNonlinSol_FixedPoint(y_.get(), 0, context_));
      check(CVodeSetNonlinearSolver(memory(), fixed_point_.get()));
    }
    check(CVodeRootInit(memory(), root_count, roots));
    std::array<int, root_count> directions;
    for (int k = 0; k < root_count; ++k) directions[k] = k < System::guard_count ? -1 : 1;  // guards fall, rates rise
    check(CVodeSetRootDirection(memory(), directions.data()));
    check(CVodeSetNoInactiveRootWarn(memory()));
    silence();
  }
  CvodeSolver(const CvodeSolver&) = delete;
  CvodeSolver& operator=(const CvodeSolver&) = delete;

  /// Takes up a new state; what the solver counted so far is kept, for CVODE forgets it here.
  void restart(const Instant& now) {
    total_ = statistics();
    ++total_.restarts;
    ahead_ = now;
    fired_.reset();
    finite_ = true;
    state() = now.x;
    check(CVodeReInit(memory(), now.t, y_.get()));
    if constexpr (requires { system_.longest_step(now.mode); })
      set_longest_step(std::min(max_step_, system_.longest_step(now.mode)));
    limit_ = std::numeric_limits<double>::quiet_NaN();
  }

  /// Integrates to next (<= limit, past which nothing is evaluated); returns the guard that stopped it earlier.
  std::optional<int> advance(Instant& now, double next, double limit) {
    if (already_there(now.t, next)) {
      now.t = next;
      return std::nullopt;
    }
    if (limit != limit_) check(CVodeSetStopTime(memory(), limit_ = limit));
    for (long step = 0; ahead_.t < next && !fired_; ++step) {
      const int flag = CVode(memory(), next, y_.get(), &ahead_.t, next < limit ? CV_ONE_STEP : CV_NORMAL);
      if (flag < 0 || step == max_steps) {
        now.t = ahead_.t;
        throw SolverFault(reason(flag >= 0 ? CV_TOO_MUCH_WORK : finite_ ? flag : CV_RHSFUNC_FAIL));
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
    return std::nullopt;
  }

  /// What the solver did since it was made.
  SolverStatistics statistics() const {
    SolverStatistics sum = total_;
    long steps = 0, evaluations = 0, jacobians = 0, failures = 0, roots = 0;
    check(CVodeGetNumSteps(memory(), &steps));
    check(CVodeGetNumRhsEvals(memory(), &evaluations));
    check(CVodeGetNumErrTestFails(memory(), &failures));
    check(CVodeGetNumGEvals(memory(), &roots));
    if (linear_) check(CVodeGetNumJacEvals(memory(), &jacobians));
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

  struct Free {
    void operator()(void* memory) const { CVodeFree(&memory); }
    void operator()(N_Vector v) const { N_VDestroy(v); }
    void operator()(SUNMatrix A) const { SUNMatDestroy(A); }
    void operator()(SUNLinearSolver s) const { SUNLinSolFree(s); }
    void operator()(SUNNonlinearSolver s) const { SUNNonlinSolFree(s); }
  };
  template <class Handle>
  using Owned = std::unique_ptr<std::remove_pointer_t<Handle>, Free>;

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
  std::optional<int> crossed() const {
    std::array<int, root_count> found;
    check(CVodeGetRootInfo(memory(), found.data()));
    for (int k = 0; k < System::guard_count; ++k)
      if (found[k] != 0) return k;
    return std::nullopt;
  }

  void* memory() const { return memory_.get(); }
  Eigen::Map<State> state() { return Eigen::Map<State>(N_VGetArrayPointer(y_.get())); }
  /// At a time within the latest step.
  Eigen::Map<State> state_at(double t) {
    check(CVodeGetDky(memory(), t, 0, y_.get()));
    return state();
  }

  void set_longest_step(double step) { check(CVodeSetMaxStep(memory(), std::isfinite(step) ? step : 0.0)); }

  static std::string reason(int flag) {
    switch (flag) {
      case CV_TOO_MUCH_WORK: return "CVODE took 10 million steps without getting there";
      case CV_TOO_MUCH_ACC: return "the tolerance is finer than the arithmetic; raise run.relative_tolerance";
      case CV_ERR_FAILURE: return "CVODE's error test failed repeatedly at the smallest step";
      case CV_CONV_FAILURE: return "CVODE's nonlinear solver does not converge at the smallest step";
      case CV_RHSFUNC_FAIL: return "the acceleration is not a finite number";
    }
    const std::unique_ptr<char, decltype(&std::free)> name(CVodeGetReturnFlagName(flag), &std::free);
    return std::string("CVODE stopped with ") + name.get();
  }
  static void check(int flag) {
    if (flag < 0) throw SolverFault(reason(flag));
  }
  /// Faults are told once, by the exception.
  void silence() {
#if SUNDIALS_VERSION_MAJOR >= 7
    SUNContext_ClearErrHandlers(context_);
    SUNContext_PushErrHandler(
        context_, [](int, const char*, const char*, const char*, SUNErrCode, void*, SUNContext) {}, nullptr);
#else
    check(CVodeSetErrHandlerFn(
        memory(), [](int, const char*, const char*, char*, void*) {}, nullptr));
#endif
  }

  const System& system_;
  double max_step_;  ///< [s]
  sundials::Context context_;
  Owned<N_Vector> y_;
  Owned<SUNMatrix> matrix_;
  Owned<SUNLinearSolver> linear_;
  Owned<SUNNonlinearSolver> fixed_point_;
  std::unique_ptr<void, Free> memory_;
  Instant ahead_{};           ///< how far CVODE has gone without a guard firing ...
  std::optional<int> fired_;  ///< ... or the guard that fired there
  bool finite_ = true;        ///< every acceleration since the latest restart was a number
  double limit_ = std::numeric_limits<double>::quiet_NaN();
  SolverStatistics total_{};
};

}  // namespace wormdrive
