#pragma once
#include <cstdlib>
#include <memory>
#include <string>
#include <type_traits>

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.hpp>
#include <sundials/sundials_version.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "events/simulation_failure.hpp"

namespace wormdrive {

/// Gives back what SUNDIALS has made.
struct CvodeFree {
  void operator()(void* memory) const { CVodeFree(&memory); }
  void operator()(N_Vector v) const { N_VDestroy(v); }
  void operator()(SUNMatrix A) const { SUNMatDestroy(A); }
  void operator()(SUNLinearSolver s) const { SUNLinSolFree(s); }
  void operator()(SUNNonlinearSolver s) const { SUNNonlinSolFree(s); }
};
template <class Handle>
using CvodeOwned = std::unique_ptr<std::remove_pointer_t<Handle>, CvodeFree>;
using CvodeMemory = std::unique_ptr<void, CvodeFree>;

/// What a flag of CVODE means for a run.
inline std::string cvode_reason(int flag) {
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
inline void check_cvode(int flag) {
  if (flag < 0) throw SolverFault(cvode_reason(flag));
}

/// Of one step. From the third on CVODE lowers the order by one with each failure, of Adams' formulas from twelve,
/// before it begins anew and shortens the step to a tenth each time.
inline constexpr int usual_error_test_failures = 3, most_error_test_failures = 20;

/// Diagnostics are told once, by the exception.
inline void silence_cvode([[maybe_unused]] SUNContext context, [[maybe_unused]] void* memory) {
#if SUNDIALS_VERSION_MAJOR >= 7
  SUNContext_ClearErrHandlers(context);
  SUNContext_PushErrHandler(
      context, [](int, const char*, const char*, const char*, SUNErrCode, void*, SUNContext) {}, nullptr);
#else
  check_cvode(CVodeSetErrHandlerFn(
      memory, [](int, const char*, const char*, char*, void*) {}, nullptr));
#endif
}

/// One of the numbers that CVODE counts.
inline long cvode_count(void* memory, int (*of)(void*, long*)) {
  long number = 0;
  check_cvode(of(memory, &number));
  return number;
}

}  // namespace wormdrive
