#pragma once
#include <algorithm>
#include <cstddef>

#include <ceres/jet.h>

#include "core/load.hpp"
#include "core/states/starting_state.hpp"
#include "events/event_sequence.hpp"
#include "events/sensitivity/cvodes_sensitivity.hpp"
#include "events/sensitivity/saltation.hpp"
#include "events/sensitivity/sensitivity.hpp"
#include "events/sensitivity/series_sensitivity.hpp"
#include "events/solvers.hpp"

namespace wormdrive {

/// A scalar with its derivatives by four parameters, as many as are followed at a time: more would share the cost of
/// the state itself, fewer carry less that nobody asked for.
using Followed = ceres::Jet<double, 4>;

/// The values in a state that a row of the result shows: angle, speed and the states that effects have.
template <class State>
auto shown(const State& x, const std::vector<Sensitivities::State>& of_effects) {
  Eigen::Matrix<typename State::Scalar, Eigen::Dynamic, 1> row(2 + static_cast<Eigen::Index>(of_effects.size()));
  row.template head<2>() = x.template head<2>();
  for (std::size_t k = 0; k < of_effects.size(); ++k)
    row[static_cast<Eigen::Index>(2 + k)] = x[static_cast<Eigen::Index>(2 + of_effects[k].place)];
  return row;
}

/// The rows and events of a run, their derivatives by the parameters still zero.
template <class System>
Sensitivities outline(const EventSequence<System>& sequence, const System& drive,
                      std::span<const Parameter> parameters) {
  Sensitivities made{{parameters.begin(), parameters.end()}, {}, {}, {}};
  if constexpr (System::state_size > 2)
    drive.effects().for_each_state([&](std::string_view effect, const EffectState& state, std::size_t place) {
      made.states.push_back({effect, state, place});
    });
  const auto count = static_cast<Eigen::Index>(parameters.size());
  for (const auto& stop : sequence.stops()) {
    const auto& now = stop.after;
    if (stop.passed()) {
      const Eigen::VectorXd state = shown(now.x, made.states);
      made.rows.push_back({now.t, state, drive.measured_angle(now), Eigen::MatrixXd::Zero(state.size(), count),
                           Eigen::RowVectorXd::Zero(count)});
    } else if (stop.changes_mode()) {
      made.events.push_back({now.t, stop.before.mode, now.mode, Eigen::RowVectorXd::Zero(count)});
    }
  }
  return made;
}

/// The measured angle as the sensor hands it on, which is at a time that does not move with the sensor's delay: the
/// longer the delay, the earlier the angle.
template <class Drive>
auto handed_on(const Drive& drive, typename Drive::Instant now) {
  const auto age = drive.effects().measuring_delay();
  now.x -= drive.derivative(now.t, now.x, now.mode) * typename Drive::State::Scalar(age - age.a);
  return drive.measured_angle(now);
}

/// Carries a state of Jets along a run and writes the derivatives by `count` parameters, from column `first` on.
template <class System, class Drive, class Carrier>
void follow(const EventSequence<System>& sequence, Drive& drive, Carrier& carrier, typename Drive::Instant now,
            Eigen::Index first, Eigen::Index count, Sensitivities& made) {
  const auto write = [&](auto&& row, const Followed& value) {
    row.segment(first, count) = value.v.head(count).transpose();
  };
  const auto limit = [&](auto stop) {
    while (stop->cause.reason == Reason::report) ++stop;
    return stop->before.t;
  };
  auto row = made.rows.begin();
  auto event = made.events.begin();
  const auto& stops = sequence.stops();
  for (auto stop = stops.begin(); stop != stops.end(); ++stop) {
    const bool waits = Drive::at_rest(now.mode) || now.t > stop->before.t;  // a bend has been left that far
    if (!waits) carrier.advance(now, stop->before.t);
    if (stop->passed()) {
      if (!waits) take_values(now, stop->before.x);
      const auto state = shown(now.x, made.states);
      for (Eigen::Index k = 0; k < state.size(); ++k) write(row->state_by.row(k), state[k]);
      write(row->measured_by, handed_on(drive, now));
      ++row;
      continue;
    }
    now.t = stop->before.t;
    const Followed t = cross(drive, now, *stop);
    if (stop->changes_mode()) write((event++)->time_by, t);
    if (Drive::at_rest(now.mode)) continue;
    const double end = limit(stop + 1);
    if (stop->is_bend()) leave_bend(drive, now, stop->hidden, end);
    carrier.restart(now, end);
  }
}

template <bool with_states>
using StatedDrive = WormDrive<double, SummedLoad, with_states>;

/// The derivatives by parameters along what a run from `begin` [s] on has met.
template <bool with_states>
Sensitivities derivatives(const EventSequence<StatedDrive<with_states>>& sequence,
                          const StatedDrive<with_states>& system, double begin, const RigidDrive& parts,
                          std::span<const Parameter> parameters, const SolverSettings& settings) {
  Sensitivities made = outline(sequence, system, parameters);
  constexpr std::size_t together = Followed::DIMENSION;
  for (std::size_t first = 0; first < parameters.size(); first += together) {
    const auto some = parameters.subspan(first, std::min(together, parameters.size() - first));
    SeededDrive<Followed, with_states> seeded(parts, some);
    using Drive = decltype(seeded.drive);
    const auto count = static_cast<Eigen::Index>(some.size());
    // what moves at the start is in the mode that it goes on in: nothing has happened yet
    const Mode mode = parts.initial.omega_g != 0.0 ? sequence.stops().front().after.mode : Mode{};
    Drive entered = seeded.drive;  // the derivatives start before a torque that stands from there on has arrived
    entered.enter(begin);
    const typename Drive::Instant now{begin, starting_state(entered, seeded.initial, begin), mode, {}};
    const auto along = [&](auto carrier) {
      follow(sequence, seeded.drive, carrier, now, static_cast<Eigen::Index>(first), count, made);
    };
    switch (settings.solver) {
      case SolverKind::cvode: along(CvodesSensitivity<Drive>(seeded.drive, some, settings)); break;
      case SolverKind::taylor: along(SeriesSensitivity<Drive>(seeded.drive, some, settings)); break;
    }
  }
  return made;
}

/// Whoever holds a torque from sample to sample.
struct Holder {
  const HeldTorque& torque;

  template <class System>
  double sample(const System& system, const typename System::Instant& now) const {
    return torque ? torque(now.t, system.measured_angle(now)) : 0.0;
  }
};

/// A run of a drive whose effects have states, or of one whose effects have none, with its derivatives.
template <bool with_states>
Sensitivities sensitivities_of(const RigidDrive& parts, std::span<const Parameter> parameters,
                               const Timetable& timetable, const SolverSettings& settings, const HeldTorque& held) {
  using System = StatedDrive<with_states>;
  System system(parts.mesh, make_load(parts.load), parts.effects, parts.motor);
  typename System::Instant start{timetable.next_time(), System::State::Zero(), {}};
  system.enter(start.t);
  start.x = starting_state(system, parts.initial, start.t);
  EventSequence<System> sequence(start);
  Holder holder{held};
  with_solver(system, settings, [&](auto& solver) { simulate(system, solver, holder, timetable, start, sequence); });
  return derivatives<with_states>(sequence, system, start.t, parts, parameters, settings);
}
extern template Sensitivities sensitivities_of<true>(const RigidDrive&, std::span<const Parameter>, const Timetable&,
                                                     const SolverSettings&, const HeldTorque&);

}  // namespace wormdrive
