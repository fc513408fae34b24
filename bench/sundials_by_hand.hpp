#pragma once
#include <stdexcept>
#include <string>

#include <arkode/arkode_erkstep.h>
#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.hpp>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

namespace bench {

inline constexpr double absolute_part = 0.01;  ///< absolute tolerance over relative tolerance, for every contender

inline void check(int flag, const char* what) {
  if (flag < 0) throw std::runtime_error(std::string(what) + " failed with " + std::to_string(flag));
}

/// What SUNDIALS calls; the user data is the plant.
template <class Plant>
struct Callbacks {
  static int right_hand_side(sunrealtype t, N_Vector y, N_Vector rate, void* plant) {
    static_cast<Plant*>(plant)->derivative(t, NV_DATA_S(y), NV_DATA_S(rate));
    return 0;
  }
  static int jacobian(sunrealtype, N_Vector y, N_Vector, SUNMatrix J, void* data, N_Vector, N_Vector, N_Vector) {
    const Plant& plant = *static_cast<Plant*>(data);
    SM_ELEMENT_D(J, 0, 0) = 0.0;
    SM_ELEMENT_D(J, 0, 1) = 1.0;
    SM_ELEMENT_D(J, 1, 0) = plant.acceleration(plant.mode, 0.0, Plant::load_slope(NV_Ith_S(y, 0)));
    SM_ELEMENT_D(J, 1, 1) = 0.0;
    return 0;
  }
  static int roots(sunrealtype t, N_Vector y, sunrealtype* g, void* plant) {
    static_cast<Plant*>(plant)->roots(t, NV_DATA_S(y), g);
    return 0;
  }
};

inline int root_found(const int (&found)[2]) { return found[1] != 0 ? 1 : 0; }

/// Plain calls of CVODE: Adams with fixed point, or BDF with Newton and the exact Jacobian.
template <class Plant, bool bdf>
class CvodeByHand {
 public:
  CvodeByHand(Plant& plant, double tolerance) : y_(N_VNew_Serial(2, context_)) {
    N_VConst(0.0, y_);
    cvode_ = CVodeCreate(bdf ? CV_BDF : CV_ADAMS, context_);
    check(CVodeInit(cvode_, Callbacks<Plant>::right_hand_side, 0.0, y_), "CVodeInit");
    check(CVodeSStolerances(cvode_, tolerance, absolute_part * tolerance), "CVodeSStolerances");
    check(CVodeSetUserData(cvode_, &plant), "CVodeSetUserData");
    check(CVodeSetMaxNumSteps(cvode_, 1'000'000), "CVodeSetMaxNumSteps");
    if constexpr (bdf) {
      matrix_ = SUNDenseMatrix(2, 2, context_);
      linear_ = SUNLinSol_Dense(y_, matrix_, context_);
      check(CVodeSetLinearSolver(cvode_, linear_, matrix_), "CVodeSetLinearSolver");
      check(CVodeSetJacFn(cvode_, Callbacks<Plant>::jacobian), "CVodeSetJacFn");
    } else {
      fixed_point_ = SUNNonlinSol_FixedPoint(y_, 0, context_);
      check(CVodeSetNonlinearSolver(cvode_, fixed_point_), "CVodeSetNonlinearSolver");
    }
    int falling[] = {-1, -1};
    check(CVodeRootInit(cvode_, 2, Callbacks<Plant>::roots), "CVodeRootInit");
    check(CVodeSetRootDirection(cvode_, falling), "CVodeSetRootDirection");
    check(CVodeSetNoInactiveRootWarn(cvode_), "CVodeSetNoInactiveRootWarn");
  }
  ~CvodeByHand() {
    CVodeFree(&cvode_);
    SUNNonlinSolFree(fixed_point_);
    SUNLinSolFree(linear_);
    SUNMatDestroy(matrix_);
    N_VDestroy(y_);
  }
  CvodeByHand(const CvodeByHand&) = delete;
  CvodeByHand& operator=(const CvodeByHand&) = delete;

  void restart(double t, const typename Plant::State& y, double stop) {
    NV_Ith_S(y_, 0) = y[0];
    NV_Ith_S(y_, 1) = y[1];
    check(CVodeReInit(cvode_, t, y_), "CVodeReInit");
    check(CVodeSetStopTime(cvode_, stop), "CVodeSetStopTime");
  }
  int advance(double& t, typename Plant::State& y, double end) {
    const int flag = CVode(cvode_, end, y_, &t, CV_NORMAL);
    check(flag, "CVode");
    y = {NV_Ith_S(y_, 0), NV_Ith_S(y_, 1)};
    if (flag != CV_ROOT_RETURN) {
      t = end;
      return -1;
    }
    int found[2];
    check(CVodeGetRootInfo(cvode_, found), "CVodeGetRootInfo");
    return root_found(found);
  }

 private:
  sundials::Context context_;
  N_Vector y_;
  void* cvode_ = nullptr;
  SUNMatrix matrix_ = nullptr;
  SUNLinearSolver linear_ = nullptr;
  SUNNonlinearSolver fixed_point_ = nullptr;
};

/// Plain calls of ARKODE's explicit Runge-Kutta module, which keeps its step size over a restart.
template <class Plant, int order>
class ErkstepByHand {
 public:
  ErkstepByHand(Plant& plant, double tolerance) : y_(N_VNew_Serial(2, context_)) {
    N_VConst(0.0, y_);
    arkode_ = ERKStepCreate(Callbacks<Plant>::right_hand_side, 0.0, y_, context_);
    check(ERKStepSStolerances(arkode_, tolerance, absolute_part * tolerance), "ERKStepSStolerances");
    check(ERKStepSetUserData(arkode_, &plant), "ERKStepSetUserData");
    check(ERKStepSetOrder(arkode_, order), "ERKStepSetOrder");
    check(ERKStepSetMaxNumSteps(arkode_, 1'000'000), "ERKStepSetMaxNumSteps");
    int falling[] = {-1, -1};
    check(ERKStepRootInit(arkode_, 2, Callbacks<Plant>::roots), "ERKStepRootInit");
    check(ERKStepSetRootDirection(arkode_, falling), "ERKStepSetRootDirection");
    check(ERKStepSetNoInactiveRootWarn(arkode_), "ERKStepSetNoInactiveRootWarn");
  }
  ~ErkstepByHand() {
    ERKStepFree(&arkode_);
    N_VDestroy(y_);
  }
  ErkstepByHand(const ErkstepByHand&) = delete;
  ErkstepByHand& operator=(const ErkstepByHand&) = delete;

  void restart(double t, const typename Plant::State& y, double stop) {
    NV_Ith_S(y_, 0) = y[0];
    NV_Ith_S(y_, 1) = y[1];
    check(ERKStepReset(arkode_, t, y_), "ERKStepReset");
    check(ERKStepSetInitStep(arkode_, step_), "ERKStepSetInitStep");
    check(ERKStepSetStopTime(arkode_, stop), "ERKStepSetStopTime");
  }
  int advance(double& t, typename Plant::State& y, double end) {
    const int flag = ERKStepEvolve(arkode_, end, y_, &t, ARK_NORMAL);
    check(flag, "ERKStepEvolve");
    check(ERKStepGetCurrentStep(arkode_, &step_), "ERKStepGetCurrentStep");
    y = {NV_Ith_S(y_, 0), NV_Ith_S(y_, 1)};
    if (flag != ARK_ROOT_RETURN) {
      t = end;
      return -1;
    }
    int found[2];
    check(ERKStepGetRootInfo(arkode_, found), "ERKStepGetRootInfo");
    return root_found(found);
  }

 private:
  sundials::Context context_;
  N_Vector y_;
  void* arkode_ = nullptr;
  double step_ = 0.0;  ///< 0 lets ARKODE choose the first one
};

}  // namespace bench
