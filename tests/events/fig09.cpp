#include <cmath>
#include <string>

#include "catch.hpp"
#include "support.hpp"

// Fig. 9 of the paper against the same equations integrated in 128-bit arithmetic.

namespace wormdrive::test::events_fig09 {

namespace {

constexpr double event_times[] = {0.0034812139, 0.3612729976, 0.5951950127, 0.7015616874, 0.7344678947, 0.9265462573,
                                  1.2469025129, 1.4124534693, 1.4134879343, 1.6469508927, 1.9134994320, 1.9383624501};
constexpr double end_angle = -5.4068889175374455, end_speed = 1.0836146975023262;

constexpr Mode stuck{}, forward_left{Motion::forward, Flank::left}, forward_right{Motion::forward, Flank::right},
    backward_left{Motion::backward, Flank::left}, backward_right{Motion::backward, Flank::right};

const std::vector<Mode> sequence{stuck,          backward_left,  backward_right, forward_right, forward_left,
                                 backward_left,  backward_right, forward_right,  forward_left,  backward_left,
                                 backward_right, forward_right,  forward_left};

auto fig9(const SolverSettings& settings) {
  return run(drive(table1(), fig9_load(), fig9_motor()), Timetable(0, 2, 0.001), {}, settings);
}

}  // namespace

TEST_CASE("fig. 9 has 12 events and every solver finds each of them where 128-bit arithmetic does") {
  for (By method : every_solver) {
    const auto r = fig9(tight(method, 1e-12));
    REQUIRE(r.modes() == sequence);
    Deviation times;
    for (std::size_t k = 0; k < 12; ++k) times.add(r.events[k].after.t - event_times[k]);
    REQUIRE(times <= 1e-10 + 0.5e-10);  // the times are known to ten decimals
    REQUIRE(std::abs(r.end.x[0] - end_angle) <= 1e-9);
    REQUIRE(std::abs(r.end.x[1] - end_speed) <= 1e-9);
  }
}

TEST_CASE("fig. 9 is one break-away backward, six flank changes and five reversals") {
  const auto r = fig9(tight(adams, 1e-10));
  int break_aways = 0, flank_changes = 0, reversals = 0;
  for (const auto& event : r.events) {
    if (event.before.mode.motion == Motion::stuck)
      ++break_aways;
    else if (event.before.mode.motion == event.after.mode.motion)
      ++flank_changes;
    else
      ++reversals;
  }
  REQUIRE((break_aways == 1 && flank_changes == 6 && reversals == 5));
}

TEST_CASE("fig. 9 has the same mode sequence at every tolerance, and its end converges with it") {
  for (By method : every_solver)
    for (int digits = 6; digits <= 13; ++digits) {
      const double tolerance = std::pow(10.0, -digits);
      const auto r = fig9(tight(method, tolerance));
      REQUIRE(r.modes() == sequence);
      REQUIRE(std::abs(r.end.x[1] - end_speed) <= 3000.0 * tolerance);
    }
}

TEST_CASE("fig. 9 jumps in acceleration at its reversals, not at the break-away and not where the flank changes") {
  const auto r = fig9(tight(adams, 1e-12));
  const auto d = entered(table1(), fig9_load(), fig9_motor());
  for (const auto& event : r.events) {
    const double jump = d.observe(event.after).alpha_g - d.observe(event.before).alpha_g;
    const bool from_rest = event.before.mode.motion == Motion::stuck;
    if (from_rest || event.before.mode.motion == event.after.mode.motion)
      REQUIRE(std::abs(jump) <= 1e-8);
    else
      REQUIRE(std::abs(jump) >= 0.01);
  }
}

}  // namespace wormdrive::test::events_fig09
