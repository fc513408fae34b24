#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.hpp>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "core/numbers/crossing.hpp"
#include "core/ripple.hpp"
#include "events/allowed_error.hpp"
#include "events/bend_watch.hpp"
#include "events/cvode_handles.hpp"
#include "events/first_step.hpp"
#include "events/growth.hpp"
#include "events/integrated_state.hpp"
#include "events/segment_start.hpp"
#include "events/simulation_failure.hpp"
#include "events/solver_settings.hpp"
#include "events/timetable.hpp"

namespace wormdrive {

/// SUNDIALS CVODE: BDF with Newton and the exact Jacobian, or Adams with fixed point.
///
/// CVODE goes step by step, ahead of the reports that fall into a step; those are read off the step's polynomial. After
/// every step all guards are looked at with value and rate, at its end and so often on its way that they turn at most
/// once in between, so that one that dips below zero and comes back is seen as well as one that ends below. Their roots
/// are found on the polynomial to a few roundings of the time. (CVODE's own roots are a hundred units in the last place
/// coarse, 2 ns after a day.) Its clock begins at zero with every segment, so that a step after a day is as fine as one
/// at the start. No step ends in a mode that its state contradicts.
template <class System>
class CvodeSolver {
 public:
  using Instant = typename System::Instant;
  using State = typename System::State;

  /// The system must outlive the solver; its inputs and parameters may change between restarts.
  CvodeSolver(const System& system, const SolverSettings& settings)
      : system_(system), settings_(settings), y_(N_VNew_Serial(System::state_size, context_)) {
    memory_.reset(CVodeCreate(settings.method == Method::bdf ? CV_BDF : CV_ADAMS, context_));
    if (!memory_ || !y_) throw std::bad_alloc();
    check_cvode(CVodeInit(memory(), right_hand_side, 0.0, y_.get()));
    check_cvode(CVodeWFtolerances(memory(), error_weights));
    check_cvode(CVodeSetUserData(memory(), this));
    check_cvode(CVodeSetMaxNumSteps(memory(), max_steps));
    check_cvode(CVodeSetMaxErrTestFails(memory(), most_error_test_failures));
    if (settings.method == Method::bdf) {
      matrix_.reset(SUNDenseMatrix(System::state_size, System::state_size, context_));
      linear_.reset(SUNLinSol_Dense(y_.get(), matrix_.get(), context_));
      check_cvode(CVodeSetLinearSolver(memory(), linear_.get(), matrix_.get()));
      check_cvode(CVodeSetJacFn(memory(), jacobian));
    } else {
      fixed_point_.reset(SUNNonlinSol_FixedPoint(y_.get(), 0, context_));
      check_cvode(CVodeSetNonlinearSolver(memory(), fixed_point_.get()));
    }
    silence_cvode(context_, memory());
  }
  CvodeSolver(const CvodeSolver&) = delete;
  CvodeSolver& operator=(const CvodeSolver&) = delete;

  /// Takes up a new state; what the solver counted so far is kept, for CVODE forgets it here.
  void restart(const Instant& now) {
    ++total_.restarts;
    ahead_ = now;
    fired_ = no_guard;
    finite_ = true;
    first_.restart(system_, now, settings_);
    if (!first_.leaves_rest()) begin();
  }

  /// Integrates to next (<= limit, past which nothing is evaluated); returns the guard that stopped it earlier, or
  /// no_guard.
  int advance(Instant& now, double next, double limit) {
    if constexpr (Foresees<System>)
      if (first_.any()) {
        if (first_.advance(now, next, settings_, [&](const Instant& from) { return first_step(from, limit); }))
          return first_.fired(now.t);
        ahead_ = now;
        begin();
      }
    if (already_there(now.t, next)) {
      now.t = next;
      return no_guard;
    }
    for (long steps = 0; ahead_.t < next && fired_ == no_guard; ++steps) {
      if (steps == max_steps) throw SolverFault(cvode_reason(CV_TOO_MUCH_WORK));
      step(now, next, limit);
    }
    const bool is_end = ahead_.t <= next;  // of the latest step, or of what an event left of it
    if (is_end) {
      now = ahead_;
    } else {
      now.t = next;
      now.x = state_at(std::clamp(next - origin_, clock_ - step_, clock_));
    }
    if constexpr (Foresees<System>) system_.keep_within_mode(now);
    return is_end ? fired_ : no_guard;
  }

  /// What the solver did since it was made.
  SolverStatistics statistics() const {
    SolverStatistics sum = total_;
    sum.steps += cvode_count(memory(), CVodeGetNumSteps);
    sum.evaluations += cvode_count(memory(), CVodeGetNumRhsEvals);
    if (linear_) sum.jacobians += cvode_count(memory(), CVodeGetNumJacEvals);
    sum.error_test_failures += cvode_count(memory(), CVodeGetNumErrTestFails);
    return sum;
  }

 private:
  using Guards = decltype(std::declval<const System&>().guards_ahead(std::declval<const Instant&>()));
  static constexpr long max_steps = 10'000'000;  ///< between two stops; a stalled run fails earlier for its step size

  static int right_hand_side(sunrealtype clock, N_Vector y, N_Vector ydot, void* self) {
    auto& solver = *static_cast<CvodeSolver*>(self);
    const State dx = solver.system_.derivative(solver.origin_ + clock, solver.state_of(y), solver.ahead_.mode);
    Eigen::Map<State>(N_VGetArrayPointer(ydot)) = integrated_state(solver.system_, dx);
    // once is for good: the fixed-point iteration would only shorten its step and try again, without end
    solver.finite_ = solver.finite_ && dx.allFinite();
    return solver.finite_ ? 0 : -1;
  }
  static int jacobian(sunrealtype clock, N_Vector y, N_Vector, SUNMatrix J, void* self, N_Vector, N_Vector, N_Vector) {
    const auto& solver = *static_cast<const CvodeSolver*>(self);
    Eigen::Map<typename System::Jacobian>(SUNDenseMatrix_Data(J)) = integrated_jacobian(
        solver.system_, solver.system_.jacobian(solver.origin_ + clock, solver.state_of(y), solver.ahead_.mode));
    return 0;
  }
  static int error_weights(N_Vector y, N_Vector weights, void* self) {
    const auto& solver = *static_cast<const CvodeSolver*>(self);
    double step = 0.0;
    if (solver.rounding_counts_) CVodeGetCurrentStep(solver.memory(), &step);
    Instant now = solver.ahead_;
    now.x = solver.state_of(y);
    Eigen::Map<State>(N_VGetArrayPointer(weights)) = weights_of_errors(solver.system_, now, solver.settings_, step);
    return 0;
  }
  /// Whether the error test is busy with rounding: its failures tell, or steps that are many and short.
  bool meets_rounding() {
    const long before = std::exchange(failures_, cvode_count(memory(), CVodeGetNumErrTestFails));
    if (failures_ - before > usual_error_test_failures) return true;
    return cvode_count(memory(), CVodeGetNumSteps) % 1000 == 0 && mostly_rounding(system_, ahead_, settings_, step_);
  }
  FirstStep<System> first_step(const Instant& now, double limit) requires Foresees<System> {
    FirstStep<System> step(system_, now, limit, longest_step(now, ripple_rate(system_, now.x)),
                           for_each_speed(system_, now, settings_));
    total_.evaluations += step.evaluations();
    ++total_.steps;
    return step;
  }
  /// Lets CVODE begin at ahead_.
  void begin() {
    start_clock();
    bend_at_ = std::numeric_limits<double>::infinity();
    if constexpr (Foresees<System>) friction_changes_ = system_.effects().change_friction();
    floor_.fill(0.0);
    const auto starts = guard_starts(system_, ahead_, guards_at(ahead_));
    floor_ = starts.floor;
    fired_ = starts.fallen;
    guards_ = guards_at(ahead_);
    bends_.begin(ahead_);
  }
  void start_clock() {
    total_ = statistics();
    Eigen::Map<State>(N_VGetArrayPointer(y_.get())) = integrated_state(system_, ahead_.x);
    origin_ = ahead_.t;
    check_cvode(CVodeReInit(memory(), clock_ = 0.0, y_.get()));
    failures_ = 0;
    rounding_counts_ = false;
    limit_ = std::numeric_limits<double>::quiet_NaN();
  }
  /// Takes the latest step back to where the clock showed `from`, to go on to a bend in it without a look behind: a
  /// polynomial through a bend is nowhere in its step as near to the motion as the error of its end.
  void approach_bend(double from) {
    ahead_ = at(from);
    start_clock();
    guards_ = guards_at(ahead_);
    if (already_there(ahead_.t, bend_at_)) fired_ = bends_.guard;
  }
  /// One step of CVODE, and the first guard that falls through zero in it.
  void step(Instant& now, double next, double limit) {
    if (const double stop = std::min(limit, bend_at_); stop != limit_)
      check_cvode(CVodeSetStopTime(memory(), (limit_ = stop) - origin_));
    const double from = clock_, before = ripple_rate(system_, ahead_.x);
    double longest = longest_step(ahead_, before);
    if constexpr (Foresees<System>)
      if (friction_changes_) longest = shortened_by_growth(system_, ahead_, longest, limit_, total_.jacobians);
    check_cvode(CVodeSetMaxStep(memory(), std::isfinite(longest) ? longest : 0.0));
    const int flag = CVode(memory(), next - origin_, y_.get(), &clock_, CV_ONE_STEP);
    ahead_.t = flag == CV_TSTOP_RETURN ? limit_ : origin_ + clock_;
    if (flag < 0) {
      now.t = ahead_.t;
      throw SolverFault(cvode_reason(finite_ ? flag : CV_RHSFUNC_FAIL));
    }
    step_ = clock_ - from;
    ahead_.x = state_of(y_.get());
    rounding_counts_ = meets_rounding() || rounding_counts_;
    const double ripple = std::max(before, ripple_rate(system_, ahead_.x));
    const double parts = std::max(1.0, std::ceil(ripple * step_ / phase_between_looks(false)));
    for (double part = 1.0, left = from; part <= parts && fired_ == no_guard; ++part) {
      const double right = part == parts ? clock_ : from + step_ * (part / parts);
      find_event(left, right, part == parts ? ahead_ : at(right));
      if (fired_ == no_guard && bend_at_ < ahead_.t) return approach_bend(from);
      left = right;
    }
    if (fired_ == no_guard && ahead_.t >= bend_at_) fired_ = bends_.guard;
  }
  /// The first guard that falls through zero within a part of the latest step, unless a bend comes before it.
  void find_event(double left, double right, const Instant& end) {
    const Guards there = guards_at(end);
    double first = right;
    for (int g = 0; g < System::guard_count; ++g) {
      const auto guard = [&](double clock) { return guards_at(at(clock))[g]; };
      const auto fall = falling_crossing(guard, left, guards_[g], right, there[g]);
      // of what falls at one time, as a force and the friction that hangs on it, the first of the list does
      if (!fall || (fired_ != no_guard && *fall >= first - time_resolution(origin_ + first))) continue;
      first = *fall;
      fired_ = g;
    }
    guards_ = there;
    if (std::isinf(bend_at_)) {
      const auto bend = bends_.first_between([this](double clock) { return at(clock); }, left, right, end);
      if (bend && *bend <= first + time_resolution(origin_ + first)) {
        fired_ = no_guard;
        bend_at_ = origin_ + *bend;
      }
    }
    if (fired_ != no_guard) ahead_ = at(first);
  }
  /// Where the motion was when the clock showed a time of the latest step.
  Instant at(double clock) {
    Instant then = ahead_;
    if (clock < clock_) then.t = origin_ + clock;
    then.x = state_at(clock);
    return then;
  }
  Guards guards_at(const Instant& at) {
    ++total_.guard_evaluations;
    Guards guards = system_.guards_ahead(at);
    for (int g = 0; g < System::guard_count; ++g) guards[g][0] += floor_[g];
    return guards;
  }

  /// Within the longest step [s] a guard turns at most once, whatever the tolerance lets pass.
  double longest_step(const Instant& now, double ripple) const {
    const double omega = std::max(fastest_change(system_, now), ripple);
    return omega > 0.0 ? std::min(settings_.max_step, phase_between_looks(false) / omega) : settings_.max_step;
  }
  void* memory() const { return memory_.get(); }
  State state_of(N_Vector y) const {
    return state_of_integrated(system_, State(Eigen::Map<const State>(N_VGetArrayPointer(y))), ahead_);
  }
  State state_at(double clock) {
    check_cvode(CVodeGetDky(memory(), clock, 0, y_.get()));
    return state_of(y_.get());
  }

  const System& system_;
  SolverSettings settings_;
  sundials::Context context_;
  CvodeOwned<N_Vector> y_;
  CvodeOwned<SUNMatrix> matrix_;
  CvodeOwned<SUNLinearSolver> linear_;
  CvodeOwned<SUNNonlinearSolver> fixed_point_;
  CvodeMemory memory_;
  Instant ahead_{};                                  ///< how far CVODE has gone without a guard firing ...
  int fired_ = no_guard;                             ///< ... or the guard that fired there, a bend's among them
  bool finite_ = true;                               ///< every acceleration since the latest restart was a number
  FirstSteps<System> first_;                         ///< before CVODE begins, where there are any
  long failures_ = 0;                                ///< of the error test since then
  bool rounding_counts_ = false;                     ///< in the error test
  bool friction_changes_ = false;                    ///< so the longest step may be another one after each
  Guards guards_{};                                  ///< where CVODE is ...
  std::array<double, System::guard_count> floor_{};  ///< ... with the rounding of those that start at zero
  BendWatch<System> bends_{system_};
  double bend_at_ = 0.0;  ///< where the next bend is known to be [s], else infinity
  double limit_ = std::numeric_limits<double>::quiet_NaN();
  double origin_ = 0.0;  ///< where CVODE's clock began [s] ...
  double clock_ = 0.0;   ///< ... what it shows [s] ...
  double step_ = 0.0;    ///< ... and how far its latest step went [s]
  SolverStatistics total_{};
};

}  // namespace wormdrive
