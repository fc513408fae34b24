#pragma once
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "core/load.hpp"
#include "core/rigid_drive.hpp"
#include "core/states/effect_states.hpp"
#include "core/states/starting_state.hpp"
#include "events/event_sequence.hpp"
#include "events/solvers.hpp"

namespace wormdrive {

/// A run with its derivatives by parameters, all in SI.
struct Sensitivities {
  /// A state of an effect.
  struct State {
    std::string_view effect;  ///< its id
    EffectState state;
    std::size_t place;  ///< among all that effects may have
  };
  /// At a report; just behind an event at that time.
  struct Row {
    double t;                        ///< [s]
    Eigen::VectorXd state;           ///< theta_g [rad], theta_g' [rad/s], and the states of effects
    double measured;                 ///< gear angle as the sensor sees it at t and hands it on after its delay [rad]
    Eigen::MatrixXd state_by;        ///< d(state)/d(parameter), states x parameters
    Eigen::RowVectorXd measured_by;  ///< d(measured)/d(parameter), 1 x parameters
  };
  /// A change of the mode.
  struct Event {
    double t;  ///< [s]
    Mode before, after;
    Eigen::RowVectorXd time_by;  ///< dt/d(parameter), 1 x parameters
  };
  std::vector<Parameter> parameters;
  std::vector<State> states;  ///< of effects, in their order behind angle and speed
  std::vector<Row> rows;
  std::vector<Event> events;
};

template <bool with_states>
using StatedDrive = WormDrive<double, SummedLoad, with_states>;

/// The derivatives by parameters along what a run from `begin` [s] on has met.
template <bool with_states>
Sensitivities derivatives(const EventSequence<StatedDrive<with_states>>& sequence,
                          const StatedDrive<with_states>& system, double begin, const RigidDrive& parts,
                          std::span<const Parameter> parameters, const SolverSettings& settings);
extern template Sensitivities derivatives<false>(const EventSequence<StatedDrive<false>>&, const StatedDrive<false>&,
                                                 double, const RigidDrive&, std::span<const Parameter>,
                                                 const SolverSettings&);
extern template Sensitivities derivatives<true>(const EventSequence<StatedDrive<true>>&, const StatedDrive<true>&,
                                                double, const RigidDrive&, std::span<const Parameter>,
                                                const SolverSettings&);

/// A run of a drive whose effects have states, or of one whose effects have none, with its derivatives.
template <bool with_states, class Controller>
Sensitivities sensitivities_of(const RigidDrive& parts, std::span<const Parameter> parameters,
                               const Timetable& timetable, const SolverSettings& settings, Controller& controller) {
  using System = StatedDrive<with_states>;
  System system(parts.mesh, make_load(parts.load), parts.effects, parts.motor);
  typename System::Instant start{timetable.next_time(), System::State::Zero(), {}};
  system.enter(start.t);
  start.x = starting_state(system, parts.initial, start.t);
  EventSequence<System> sequence(start);
  with_solver(system, settings,
              [&](auto& solver) { simulate(system, solver, controller, timetable, start, sequence); });
  return derivatives<with_states>(sequence, system, start.t, parts, parameters, settings);
}

/// Runs a drive and finds the derivatives of its state by parameters, through every event.
///
/// settings.solver makes the run and carries the derivatives: power series of Jets, or CVODES. What the controller
/// holds is taken as given, as a recorded torque is; the derivatives do not go through its law. Throws
/// SimulationFailure or SolverFault when the run cannot go on.
template <class Controller>
Sensitivities sensitivities(const RigidDrive& parts, std::span<const Parameter> parameters, const Timetable& timetable,
                            const SolverSettings& settings, Controller& controller) {
  return parts.effects.have_states() ? sensitivities_of<true>(parts, parameters, timetable, settings, controller)
                                     : sensitivities_of<false>(parts, parameters, timetable, settings, controller);
}

/// The same in open loop.
Sensitivities sensitivities(const RigidDrive& parts, std::span<const Parameter> parameters, const Timetable& timetable,
                            const SolverSettings& settings);

}  // namespace wormdrive
