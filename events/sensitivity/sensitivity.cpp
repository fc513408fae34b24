#include "events/sensitivity/sensitivity.hpp"

#include <algorithm>
#include <cstddef>

#include <ceres/jet.h>

#include "events/sensitivity/cvodes_sensitivity.hpp"
#include "events/sensitivity/saltation.hpp"
#include "events/sensitivity/series_sensitivity.hpp"

namespace wormdrive {
namespace {

using System = WormDrive<double, SummedLoad>;

/// A scalar with its derivatives by four parameters, as many as are followed at a time: more would share the cost of
/// the state itself, fewer carry less that nobody asked for.
using Followed = ceres::Jet<double, 4>;

/// The rows and events of a course, their derivatives by the parameters still zero.
Sensitivities outline(const EventSequence<System>& sequence, const System& drive,
                      std::span<const Parameter> parameters) {
  Sensitivities made{{parameters.begin(), parameters.end()}, {}, {}};
  const auto count = static_cast<Eigen::Index>(parameters.size());
  for (const auto& stop : sequence.stops()) {
    const auto& now = stop.after;
    if (stop.passed())
      made.rows.push_back(
          {now.t, now.x, drive.measured_angle(now), Eigen::Matrix2Xd::Zero(2, count), Eigen::RowVectorXd::Zero(count)});
    else if (stop.changes_mode())
      made.events.push_back({now.t, stop.before.mode, now.mode, Eigen::RowVectorXd::Zero(count)});
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

/// Carries a state of Jets along a course and writes the derivatives by `count` parameters, from column `first` on.
template <class Drive, class Carrier>
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
    if (Drive::at_rest(now.mode))
      now.t = stop->before.t;
    else
      carrier.advance(now, stop->before.t);
    if (stop->passed()) {
      take_values(now, stop->before.x);
      for (int k = 0; k < Drive::state_size; ++k) write(row->state_by.row(k), now.x[k]);
      write(row->measured_by, handed_on(drive, now));
      ++row;
      continue;
    }
    const Followed t = cross(drive, now, *stop);
    if (stop->changes_mode()) write((event++)->time_by, t);
    if (!Drive::at_rest(now.mode)) carrier.restart(now, limit(stop + 1));
  }
}

}  // namespace

Sensitivities derivatives(const EventSequence<System>& sequence, const System& system, double begin,
                          const RigidDrive& parts, std::span<const Parameter> parameters,
                          const SolverSettings& settings) {
  Sensitivities made = outline(sequence, system, parameters);
  constexpr std::size_t together = Followed::DIMENSION;
  for (std::size_t first = 0; first < parameters.size(); first += together) {
    const auto some = parameters.subspan(first, std::min(together, parameters.size() - first));
    SeededDrive<Followed> seeded(parts, some);
    using Drive = decltype(seeded.drive);
    const auto count = static_cast<int>(some.size());
    // what moves at the start is in the mode that it goes on in: nothing has happened yet
    const Mode mode = parts.initial.omega_g != 0.0 ? sequence.stops().front().after.mode : Mode{};
    const typename Drive::Instant now{begin, {seeded.initial.theta_g, seeded.initial.omega_g}, mode, {}};
    const auto along = [&](auto carrier) {
      follow(sequence, seeded.drive, carrier, now, static_cast<Eigen::Index>(first), count, made);
    };
    switch (settings.solver) {
      case SolverKind::cvode: along(CvodesSensitivity<Drive>(seeded.drive, count, settings)); break;
      case SolverKind::taylor: along(SeriesSensitivity<Drive>(seeded.drive, settings)); break;
    }
  }
  return made;
}

Sensitivities sensitivities(const RigidDrive& parts, std::span<const Parameter> parameters, const Timetable& timetable,
                            const SolverSettings& settings) {
  NoController nobody;
  return sensitivities(parts, parameters, timetable, settings, nobody);
}

}  // namespace wormdrive
