#include <functional>

#include "catch.hpp"
#include "control/closed_loops.hpp"
#include "reference/extended_drive.hpp"

// Where samples and events meet: what is held between samples, and what happens on one, with every solver.

namespace wormdrive::test::control_sampling {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
constexpr Mode stuck{}, forward_left{Motion::forward, Flank::left}, forward_right{Motion::forward, Flank::right},
    backward_left{Motion::backward, Flank::left};

/// A controller that gives the k-th sample a torque, and notes when it was asked and what it saw.
struct Script {
  std::function<double(int)> torque;
  std::vector<double> times{};
  std::vector<double> speeds{};

  template <class System>
  double sample(const System&, const typename System::Instant& now) {
    times.push_back(now.t);
    speeds.push_back(now.x[1]);
    return torque(static_cast<int>(times.size()) - 1);
  }
};

double acceleration(Mode mode, double torque) { return torque / Branch(table1(), mode).M; }

}  // namespace

TEST_CASE("an event exactly at a sample: the gear reverses once and no sample is lost") {
  const double brake = -0.01, a = acceleration(forward_left, brake);
  for (By method : every_solver) {
    Script script{[&](int) { return brake; }};
    // the speed reaches zero at 0.5, where the fourth sample after the first lies
    const auto r = run(drive(table1(), constant(0.0), {}), Timetable(0, 1, never, {0.125, 0.0}), {0, {0, -0.5 * a}, {}},
                       tight(method), script);
    REQUIRE(script.times.size() == 8);
    for (int k = 0; k < 8; ++k) REQUIRE(script.times[k] == 0.125 * k);
    REQUIRE(std::abs(script.speeds[4]) <= 1e-12);
    REQUIRE(r.end.mode == backward_left);
    REQUIRE(std::abs(r.end.x[1] - 0.5 * acceleration(backward_left, brake)) <= 1e-11);
  }
}

TEST_CASE("a sample exactly at an event: the torque that the sample sets decides where the gear goes") {
  const double hold = 3 * 0.1;  // 0.30000000000000004: neither the sample time nor its multiple is exact
  const double brake = -0.01, push = 0.02, a = acceleration(forward_left, brake);
  for (By method : every_solver)
    for (double after : {push, 0.0}) {
      Script script{[&](int k) { return k < 3 ? brake : after; }};
      const auto r = run(drive(table1(), constant(0.0), {}), Timetable(0, 0.6, never, {0.1, 0.0}),
                         {0, {0, -hold * a}, {}}, tight(method), script);
      REQUIRE(script.times.size() == 6);
      REQUIRE(std::abs(script.speeds[3]) <= 1e-12);
      // the speed is zero to rounding: with a push it leaves forward, without one it stays where it is
      REQUIRE(std::abs(r.end.x[1] - (0.6 - hold) * acceleration(forward_right, after)) <= 1e-11);
      REQUIRE(std::abs(r.end.x[0] - (-0.5 * a * hold * hold +
                                     0.5 * acceleration(forward_right, after) * (0.6 - hold) * (0.6 - hold))) <= 1e-11);
      if (after > 0.0) REQUIRE(r.end.mode == forward_right);
    }
}

TEST_CASE(
    "stick lasts over a thousand samples whose torques stay within the band, and ends at the one that leaves it") {
  GravityArm arm;
  arm.amplitude = 0.7;
  const MeshParameters<double> p = table1();
  const GearMesh<double> mesh(p);
  const double low = -mesh.C2() * 0.7, high = -mesh.C1() * 0.7;  // of the band, at theta_g = 0
  for (By method : every_solver) {
    Script script{[&](int k) { return k < 1000 ? low + (high - low) * (0.5 + 0.499 * std::sin(k)) : 1.1 * high; }};
    const auto r = run(drive(p, arm, {}), Timetable(0, 1.05, never, {1e-3, 0.0}), {}, tight(method), script);
    REQUIRE(script.times.size() == 1050);
    REQUIRE(r.modes().front() == stuck);
    REQUIRE(r.events.size() == 1);
    REQUIRE(r.events[0].after.t == 1000 * 1e-3);
    REQUIRE(r.events[0].after.mode.motion == Motion::forward);
    for (int k = 0; k <= 1000; ++k) REQUIRE(script.speeds[k] == 0.0);
    REQUIRE(r.events[0].before.x[0] == 0.0);
  }
}

TEST_CASE("without load the flank follows the sign of the torque and the speed the sum of the held torques") {
  for (By method : every_solver) {
    const auto torque = [](int k) { return 0.02 * std::sin(0.7 * k) + 0.001; };
    Script script{torque};
    const double start = 20.0;
    const auto r = run(drive(table1(), constant(0.0), {}), Timetable(0, 0.5, never, {1e-3, 0.0}), {0, {0, start}, {}},
                       tight(method), script);
    double speed = start, angle = 0.0;
    for (int k = 0; k < 500; ++k) {
      const double a = acceleration(torque(k) <= 0.0 ? forward_left : forward_right, torque(k));
      angle += speed * 1e-3 + 0.5 * a * 1e-6;
      speed += a * 1e-3;
    }
    REQUIRE(std::abs(r.end.x[0] - angle) <= 1e-10);
    REQUIRE(std::abs(r.end.x[1] - speed) <= 1e-10);
  }
}

TEST_CASE("a reversal and a flank change within one sample are both found where extended precision has them") {
  // Braked forward: the arm's weight moves over to the other flank on the way, then the gear turns round.
  GravityArm arm = actual_load();
  const double torque = -4e-3, period = 0.6, start = -0.3, speed = 1.27;
  ExtendedDrive<long double> exact(0.0, 0.0176);
  exact.theta = start;
  exact.omega = speed;
  exact.level = torque;
  exact.settle();
  exact.advance(period);
  for (By method : every_solver) {
    Script script{[&](int) { return torque; }};
    const auto r = run(drive(table1(), arm, {}), Timetable(0, period, never, {period, 0.0}), {0, {start, speed}, {}},
                       tight(method), script);
    REQUIRE(script.times.size() == 1);
    int reversals = 0, flank_changes = 0;
    for (const auto& event : r.events)
      if (event.before.mode.motion == event.after.mode.motion)
        ++flank_changes;
      else if (event.before.mode.motion != Motion::stuck)
        ++reversals;
    REQUIRE((reversals == 1 && flank_changes == 1));
    REQUIRE(exact.events.size() == 2);
    Deviation times;
    for (std::size_t k = 0; k < 2; ++k)
      times.add(static_cast<double>(r.events[r.events.size() - 2 + k].after.t - exact.events[k].t));
    REQUIRE(times <= 1e-11);
    REQUIRE(std::abs(r.end.x[1] - static_cast<double>(exact.omega)) <= 1e-11);
  }
}

TEST_CASE("a flank change within a sample is found at a speed and a torque at which nothing else happens in it") {
  ExtendedDrive<long double> exact(0.0, 0.0176);
  exact.theta = -0.13;
  exact.omega = 5.0;
  exact.level = -4e-3;
  exact.settle();
  exact.advance(0.02);
  REQUIRE(exact.events.size() == 1);
  for (By method : every_solver) {
    Script script{[](int) { return -4e-3; }};
    const auto r = run(drive(table1(), actual_load(), {}), Timetable(0, 0.02, never, {1e-3, 0.0}),
                       {0, {-0.13, 5.0}, {}}, tight(method), script);
    REQUIRE(r.end.mode == forward_left);
    REQUIRE(std::abs(r.events.back().after.t - static_cast<double>(exact.events[0].t)) <= 1e-11);
    REQUIRE(std::abs(r.end.x[0] - static_cast<double>(exact.theta)) <= 1e-11);
  }
}

TEST_CASE("with a delay of one sample a torque arrives when the next one is decided, and none before") {
  for (By method : every_solver)
    for (double offset : {0.0, 0.4e-3}) {
      std::vector<ControlRecord> records;
      auto loop = closed_loop(sliding(), {.period = 1e-3, .offset = offset, .delay = 1.0},
                              [&](const ControlRecord& record) { records.push_back(record); });
      const auto r =
          run(drive(table1(), actual_load(), {}), Timetable(0, 0.1, never, {1e-3, offset}), {}, tight(method), loop);
      REQUIRE(records.size() == 100);
      REQUIRE(records[0].applied == 0.0);
      REQUIRE(records[0].decided.torque != 0.0);
      for (std::size_t k = 1; k < records.size(); ++k) {
        REQUIRE(records[k].measured.t == offset + static_cast<double>(k) * 1e-3);
        REQUIRE(records[k].applied == records[k - 1].decided.torque);
      }
      // what is held is what the drive sees until just before the next sample
      for (const auto& row : r.rows) {
        const auto k = static_cast<long>(std::floor((row.now.t - offset) / 1e-3 + 1e-6));
        const bool at_sample = k >= 0 && std::abs(row.now.t - offset - static_cast<double>(k) * 1e-3) < 1e-9;
        if (k >= 0 && k < 100 && !at_sample) REQUIRE(row.seen.tau_m == records[static_cast<std::size_t>(k)].applied);
      }
    }
}

TEST_CASE("at 10 kHz with a change of the flank at every sample, every sample is an event and none is another") {
  for (By method : every_solver) {
    const auto torque = [](int k) { return k % 2 == 0 ? 0.01 : -0.01; };
    Script script{torque};
    const auto r = run(drive(table1(), constant(0.0), {}), Timetable(0, 0.5, never, {1e-4, 0.0}), {0, {0, 30.0}, {}},
                       tight(method), script);
    REQUIRE(script.times.size() == 5000);
    REQUIRE(r.events.size() == 5000);  // at 0 too: without torque the flank is the left one
    for (std::size_t k = 0; k < 5000; ++k) {
      REQUIRE(r.events[k].after.t == script.times[k]);
      REQUIRE(r.events[k].after.mode == (k % 2 == 0 ? forward_right : forward_left));
    }
    const double gained = 0.25 * (acceleration(forward_right, 0.01) + acceleration(forward_left, -0.01));
    REQUIRE(std::abs(r.end.x[1] - 30.0 - gained) <= 1e-10);
  }
}

}  // namespace wormdrive::test::control_sampling
