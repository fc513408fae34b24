#pragma once
#include "events/cvode_solver.hpp"
#include "events/solver_settings.hpp"
#include "events/taylor/solver.hpp"

namespace wormdrive {

/// Makes the solver that the settings name and calls use(solver); a new solver is a new file and one line here.
template <class System, class Use>
decltype(auto) with_solver(const System& system, const SolverSettings& settings, Use&& use) {
  if (settings.solver == SolverKind::taylor) {
    if constexpr (shaft_count<System>() == 1) {
      TaylorSolver<System> solver(system, settings);
      return use(solver);
    } else {
      throw SolverFault("the solver \"taylor\" follows rigid drives only; set run.solver = \"cvode\"");
    }
  }
  CvodeSolver<System> solver(system, settings);
  return use(solver);
}

}  // namespace wormdrive
