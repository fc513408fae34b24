#pragma once
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/load.hpp"
#include "core/rigid_drive.hpp"
#include "events/event_sequence.hpp"
#include "events/solvers.hpp"

namespace wormdrive {

/// A run with its derivatives by parameters, all in SI.
struct Sensitivities {
  /// At a report; just behind an event at that time.
  struct Row {
    double t;                        ///< [s]
    Eigen::Vector2d state;           ///< theta_g [rad], theta_g' [rad/s]
    double measured;                 ///< gear angle as the sensor sees it at t and hands it on after its delay [rad]
    Eigen::Matrix2Xd state_by;       ///< d(state)/d(parameter), 2 x parameters
    Eigen::RowVectorXd measured_by;  ///< d(measured)/d(parameter), 1 x parameters
  };
  /// A change of the mode.
  struct Event {
    double t;  ///< [s]
    Mode before, after;
    Eigen::RowVectorXd time_by;  ///< dt/d(parameter), 1 x parameters
  };
  std::vector<Parameter> parameters;
  std::vector<Row> rows;
  std::vector<Event> events;
};

/// The derivatives by parameters along what a run from `begin` [s] on has met.
Sensitivities derivatives(const EventSequence<WormDrive<double, SummedLoad>>& sequence,
                          const WormDrive<double, SummedLoad>& system, double begin, const RigidDrive& parts,
                          std::span<const Parameter> parameters, const SolverSettings& settings);

/// Runs a drive and finds the derivatives of its state by parameters, through every event.
///
/// settings.solver makes the run and carries the derivatives: power series of Jets, or CVODES. What the controller
/// holds is taken as given, as a recorded torque is; the derivatives do not go through its law. Throws
/// SimulationFailure or SolverFault when the run cannot go on.
template <class Controller>
Sensitivities sensitivities(const RigidDrive& parts, std::span<const Parameter> parameters, const Timetable& timetable,
                            const SolverSettings& settings, Controller& controller) {
  using System = WormDrive<double, SummedLoad>;
  System system(parts.mesh, make_load(parts.load), parts.effects, parts.motor);
  const typename System::Instant start{timetable.next_time(), {parts.initial.theta_g, parts.initial.omega_g}, {}};
  EventSequence<System> sequence(start);
  with_solver(system, settings,
              [&](auto& solver) { simulate(system, solver, controller, timetable, start, sequence); });
  return derivatives(sequence, system, start.t, parts, parameters, settings);
}

/// The same in open loop.
Sensitivities sensitivities(const RigidDrive& parts, std::span<const Parameter> parameters, const Timetable& timetable,
                            const SolverSettings& settings);

}  // namespace wormdrive
