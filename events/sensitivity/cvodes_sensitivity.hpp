#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <new>
#include <span>

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.hpp>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include "core/rigid_drive.hpp"
#include "events/cvode_handles.hpp"
#include "events/sensitivity/derivative_scales.hpp"
#include "events/solver_settings.hpp"
#include "events/timetable.hpp"

namespace wormdrive {

/// Carries a state with its derivatives by parameters through a mode with SUNDIALS CVODES: the right-hand side of the
/// derivatives, f_x s + f_p, is what the equations return for a state of Jets.
///
/// Errors of the derivatives count. Their tolerances are the state's: the relative one as it is, the absolute one times
/// a scale of theirs.
template <class Drive>
class CvodesSensitivity {
 public:
  using Instant = typename Drive::Instant;
  using State = typename Drive::State;
  using T = typename State::Scalar;

  /// The drive must outlive this; its inputs may change between restarts. by: the parameters that are followed.
  CvodesSensitivity(const Drive& drive, std::span<const Parameter> by, const SolverSettings& settings)
      : drive_(drive),
        count_(static_cast<int>(by.size())),
        settings_(settings),
        y_(N_VNew_Serial(Drive::state_size, context_)),
        scales_(by) {
    const bool bdf = settings.method == Method::bdf;
    memory_.reset(CVodeCreate(bdf ? CV_BDF : CV_ADAMS, context_));
    if (!memory_ || !y_) throw std::bad_alloc();
    for (int k = 0; k < count_; ++k) {
      derivatives_[k].reset(N_VClone(y_.get()));
      handles_[k] = derivatives_[k].get();
    }
    N_VConst(0.0, y_.get());
    for (int k = 0; k < count_; ++k) N_VConst(0.0, handles_[k]);
    check_cvode(CVodeInit(memory(), right_hand_side, 0.0, y_.get()));
    check_cvode(CVodeSStolerances(memory(), settings.relative_tolerance, settings.absolute_tolerance));
    check_cvode(CVodeSetUserData(memory(), this));
    check_cvode(CVodeSetMaxNumSteps(memory(), 10'000'000));
    check_cvode(CVodeSetMaxErrTestFails(memory(), most_error_test_failures));
    check_cvode(CVodeSetMaxStep(memory(), std::isfinite(settings.max_step) ? settings.max_step : 0.0));
    check_cvode(CVodeSensInit(memory(), count_, CV_SIMULTANEOUS, sensitivity_right_hand_side, handles_.data()));
    check_cvode(CVodeSetSensErrCon(memory(), SUNTRUE));
    if (bdf) {
      matrix_.reset(SUNDenseMatrix(Drive::state_size, Drive::state_size, context_));
      linear_.reset(SUNLinSol_Dense(y_.get(), matrix_.get(), context_));
      check_cvode(CVodeSetLinearSolver(memory(), linear_.get(), matrix_.get()));
      check_cvode(CVodeSetJacFn(memory(), jacobian));
    } else {
      state_alone_.reset(SUNNonlinSol_FixedPoint(y_.get(), 0, context_));  // unused, but CVODES sets it up
      check_cvode(CVodeSetNonlinearSolver(memory(), state_alone_.get()));
      fixed_point_.reset(SUNNonlinSol_FixedPointSens(count_ + 1, y_.get(), 0, context_));
      check_cvode(CVodeSetNonlinearSolverSensSim(memory(), fixed_point_.get()));
    }
    silence_cvode(context_, memory());
  }
  CvodesSensitivity(const CvodesSensitivity&) = delete;
  CvodesSensitivity& operator=(const CvodesSensitivity&) = delete;

  /// Takes up a new state; behind the limit [s] the inputs or the mode differ.
  void restart(const Instant& now, double limit) {
    mode_ = now.mode;
    store(now.x, y_.get(), handles_.data());
    check_cvode(CVodeReInit(memory(), now.t, y_.get()));
    check_cvode(CVodeSensReInit(memory(), CV_SIMULTANEOUS, handles_.data()));
    check_cvode(CVodeSetStopTime(memory(), limit));
    scales_.see(drive_, now);
    std::array<double, T::DIMENSION> absolute{};
    for (int k = 0; k < count_; ++k) absolute[k] = settings_.absolute_tolerance * scales_[k];
    check_cvode(CVodeSensSStolerances(memory(), settings_.relative_tolerance, absolute.data()));
  }

  /// Carries the state to t, at most the limit.
  void advance(Instant& now, double t) {
    if (!already_there(now.t, t)) {
      check_cvode(CVode(memory(), t, y_.get(), &now.t, CV_NORMAL));
      check_cvode(CVodeGetSens(memory(), &now.t, handles_.data()));
      now.x = loaded(y_.get(), handles_.data());
    }
    now.t = t;
  }

 private:
  static int right_hand_side(sunrealtype t, N_Vector y, N_Vector ydot, void* self) {
    const auto& my = *static_cast<const CvodesSensitivity*>(self);
    return my.store(my.drive_.derivative(t, my.loaded(y), my.mode_), ydot, nullptr);
  }
  static int sensitivity_right_hand_side(int, sunrealtype t, N_Vector y, N_Vector, N_Vector* s, N_Vector* sdot,
                                         void* self, N_Vector, N_Vector) {
    const auto& my = *static_cast<const CvodesSensitivity*>(self);
    return my.store(my.drive_.derivative(t, my.loaded(y, s), my.mode_), nullptr, sdot);
  }
  /// f_x: what a derivative of the state itself adds to that of the acceleration.
  static int jacobian(sunrealtype t, N_Vector y, N_Vector, SUNMatrix J, void* self, N_Vector, N_Vector, N_Vector) {
    const auto& my = *static_cast<const CvodesSensitivity*>(self);
    const State values = my.loaded(y);
    const State by_parameters = my.drive_.derivative(t, values, my.mode_);
    for (int first = 0; first < Drive::state_size;
         first += T::DIMENSION) {  // as many columns at a time as there is room
      const int some = std::min<int>(T::DIMENSION, Drive::state_size - first);
      State seeded = values;
      for (int k = 0; k < some; ++k) seeded[first + k].v[k] = 1.0;
      const State found = my.drive_.derivative(t, seeded, my.mode_);
      for (int row = 0; row < Drive::state_size; ++row)
        for (int k = 0; k < some; ++k) SM_ELEMENT_D(J, row, first + k) = found[row].v[k] - by_parameters[row].v[k];
    }
    return 0;
  }

  /// Values and derivatives into vectors of SUNDIALS, where there are any; the flag for CVODE.
  int store(const State& x, N_Vector y, N_Vector* s) const {
    bool finite = true;
    for (int row = 0; row < Drive::state_size; ++row) {
      if (y) N_VGetArrayPointer(y)[row] = x[row].a;
      if (s)
        for (int k = 0; k < count_; ++k) N_VGetArrayPointer(s[k])[row] = x[row].v[k];
      finite = finite && std::isfinite(x[row].a) && x[row].v.allFinite();
    }
    return finite ? 0 : -1;
  }
  State loaded(N_Vector y, const N_Vector* s = nullptr) const {
    State x;
    for (int row = 0; row < Drive::state_size; ++row) {
      x[row] = T(N_VGetArrayPointer(y)[row]);
      if (s)
        for (int k = 0; k < count_; ++k) x[row].v[k] = N_VGetArrayPointer(s[k])[row];
    }
    return x;
  }
  void* memory() const { return memory_.get(); }

  const Drive& drive_;
  int count_;
  SolverSettings settings_;
  sundials::Context context_;
  CvodeOwned<N_Vector> y_;
  std::array<CvodeOwned<N_Vector>, T::DIMENSION> derivatives_;
  std::array<N_Vector, T::DIMENSION> handles_{};
  CvodeOwned<SUNMatrix> matrix_;
  CvodeOwned<SUNLinearSolver> linear_;
  CvodeOwned<SUNNonlinearSolver> state_alone_, fixed_point_;
  CvodeMemory memory_;
  Mode mode_{};
  DerivativeScales<Drive> scales_;
};

}  // namespace wormdrive
