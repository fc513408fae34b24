#pragma once
#include <limits>

namespace wormdrive {

enum class SolverKind {
  cvode,   ///< SUNDIALS CVODE, the referee
  taylor,  ///< power series, the fast path
};

/// How CVODE integrates.
enum class Method {
  bdf,    ///< backward differentiation with Newton and the exact Jacobian
  adams,  ///< Adams-Moulton with fixed-point iteration
};

/// How a solver integrates between events.
struct SolverSettings {
  SolverKind solver = SolverKind::cvode;
  Method method = Method::bdf;
  double relative_tolerance = 1e-10;
  double absolute_tolerance = 1e-12;                          ///< of the angle [rad] and of the speed [rad/s]
  double max_step = std::numeric_limits<double>::infinity();  ///< [s]
};

/// What a solver did, summed over all its restarts.
struct SolverStatistics {
  long steps = 0;
  long evaluations = 0;
  long jacobians = 0;
  long error_test_failures = 0;
  long guard_evaluations = 0;
  long restarts = 0;
};

}  // namespace wormdrive
