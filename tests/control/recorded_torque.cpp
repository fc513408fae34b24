#include "catch.hpp"
#include "control/closed_loops.hpp"
#include "reference/extended_drive.hpp"

// A closed loop amplifies the last digit of a solver; the torques that it once gave, replayed, do not.

namespace wormdrive::test::control_recorded_torque {

namespace {

constexpr double period = 1e-3;
constexpr int samples = 10'000;
constexpr double never = std::numeric_limits<double>::infinity();

/// The torques of 10 s of the sliding controller, one per sample.
Samples recorded() {
  Samples torques;
  auto loop = closed_loop(sliding(), {.period = period}, [&](const ControlRecord& record) {
    torques.times.push_back(record.measured.t);
    torques.values.push_back(record.applied);
  });
  run(drive(table1(), actual_load(), {}), Timetable(0, samples * period, never, {period, 0.0}), {}, tight(taylor),
      loop);
  return torques;
}

}  // namespace

TEST_CASE("ten seconds of recorded torque at 1 kHz end within 1e-11 of extended precision") {
  const Samples torques = recorded();
  REQUIRE(torques.values.size() == samples);
  const auto replayed =
      run(drive(table1(), actual_load(), {{torques}}), Timetable(0, samples * period, never), {}, tight(taylor));
  ExtendedDrive<long double> exact(0.0, 0.0176);
  Deviation states;
  auto row = replayed.rows.begin();
  for (int k = 0; k < samples; ++k) {
    exact.level = torques.values[k];
    exact.settle();
    exact.advance(k + 1 < samples ? torques.times[k + 1] : samples * period);
    while (row->now.t < static_cast<double>(exact.t)) ++row;
    states.add(static_cast<double>(row->now.x[0] - exact.theta));
    states.add(static_cast<double>(row->now.x[1] - exact.omega));
  }
  REQUIRE(row->now.t == replayed.end.t);
  REQUIRE(states <= 1e-11);
  REQUIRE(std::abs(replayed.end.x[1]) > 1.0);  // it moves
  std::cout << "recorded torque: " << replayed.events.size() << " changes of the mode, " << exact.events.size()
            << " of them between samples; states at all samples within " << states << "\n";
}

}  // namespace wormdrive::test::control_recorded_torque
