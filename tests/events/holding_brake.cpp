#include <cmath>
#include <limits>

#include "catch.hpp"
#include "support.hpp"

// A brake that opens and closes at given times, against uniform acceleration on paper.

namespace wormdrive::test::events_holding_brake {

namespace {

HoldingBrake<double> brake(double torque, std::optional<double> opens, std::optional<double> closes) {
  HoldingBrake<double> b;
  b.torque = torque;
  b.opens = opens;
  b.closes = closes;
  return b;
}

auto single(double J, double torque, const HoldingBrake<double>& b) {
  return WormDrive<double, TimedLoad>(GearMesh<double>::without_teeth(J), make_load(Signal{}), effects(b),
                                      constant(torque));
}

}  // namespace

TEST_CASE("a brake lets the drive go when it opens, and stops it when it closes") {
  for (const double J : {1e-5, 0.02, 30.0})
    for (const By by : every_solver) {
      const double torque = 10.0 * J, held = 35.0 * J, opens = 1.234, closes = 2.0;
      const auto seen = run(single(J, torque, brake(held, opens, closes)), Timetable(0, 3, 0.1), {}, tight(by));
      REQUIRE(seen.events.size() == 2);
      const double fastest = 10.0 * (closes - opens), slowing = 25.0;
      REQUIRE(seen.events[0].after.t == opens);
      REQUIRE(seen.events[0].after.mode.motion == Motion::forward);
      REQUIRE(std::abs(seen.events[1].after.t - (closes + fastest / slowing)) <= 1e-13);
      REQUIRE(seen.events[1].after.mode.motion == Motion::stuck);
      const double way = 0.5 * fastest * (closes - opens) + 0.5 * fastest * fastest / slowing;
      REQUIRE(std::abs(seen.end.x[0] - way) <= 1e-12);
    }
}

TEST_CASE("a brake with one time or none is closed where it should be") {
  const double never = std::numeric_limits<double>::infinity();
  struct Stated {
    std::optional<double> opens, closes;
    double from, to;  // where the drive runs
  };
  for (const Stated& s : {Stated{{}, {}, never, never}, Stated{1.0, {}, 1.0, never}, Stated{{}, 1.0, 0.0, 1.0},
                          Stated{2.0, 1.0, 0.0, 1.0}, Stated{-1.0, {}, 0.0, never}, Stated{1.0, 1.0, never, never}}) {
    const auto seen = run(single(0.01, 0.1, brake(5.0, s.opens, s.closes)), Timetable(0, 1.9, 0.1), {}, tight(taylor));
    CAPTURE(s.opens.value_or(-9), s.closes.value_or(-9));
    for (const auto& row : seen.rows) {
      if (row.now.t > s.from && row.now.t < s.to) REQUIRE(std::abs(row.now.x[1] - 10.0 * (row.now.t - s.from)) <= 1e-9);
      if (row.now.t < s.from) REQUIRE(row.now.x[1] == 0.0);
    }
    if (s.to < 1.8) REQUIRE(seen.end.mode.motion == Motion::stuck);
  }
}

}  // namespace wormdrive::test::events_holding_brake
