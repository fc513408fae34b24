#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "core/rigid_drive.hpp"
#include "core/states/effect_states.hpp"
#include "events/solver_settings.hpp"
#include "events/timetable.hpp"

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

/// The torque that is held from a sample on [N m], for its time [s] and the gear angle that the sensor shows [rad].
using HeldTorque = std::function<double(double t, double measured)>;

/// Runs a drive and finds the derivatives of its state by parameters, through every event.
///
/// settings.solver makes the run and carries the derivatives: power series of Jets, or CVODES. What is held from sample
/// to sample is taken as given, as a recorded torque is; the derivatives do not go through its law. Nothing is held in
/// open loop. Throws SimulationFailure or SolverFault when the run cannot go on.
Sensitivities sensitivities(const RigidDrive& parts, std::span<const Parameter> parameters, const Timetable& timetable,
                            const SolverSettings& settings, const HeldTorque& held = {});

}  // namespace wormdrive
