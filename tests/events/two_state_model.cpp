#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "catch.hpp"
#include "numbers.hpp"
#include "support.hpp"

// The loop and its solvers on a system that is no drive: ARGESIM comparison C5, "Two State Model" [EUROSIM Simulation
// News Europe 4 (1992)]. Two linear states, stiff, whose constants change when the first one passes a threshold:
//
//   y1' = c1 (y2 + c2 - y1), y2' = c3 (c4 - y2), y1(0) = 4.2, y2(0) = 0.3
//
// Power series are no choice here: within 1/c1 they say nothing more.

namespace wormdrive::test::events_two_state_model {

namespace {

/// What holds until y1 passes a threshold, upwards or downwards.
struct State {
  double c2, c4, threshold;
};

struct Constants {
  double c1;
  State up, down;
};
constexpr double c3 = 3.5651205, start_1 = 4.2, start_2 = 0.3;
constexpr Constants comparison{2.7e6, {0.4, 5.5, 5.8}, {-0.3, 2.73, 2.5}};  // task b
constexpr Constants frequent{2.7e6, {0.4, 5.5, 5.8}, {-1.25, 4.33, 4.1}};   // task d

/// The comparison as a hybrid system: forward is the state in which y1 rises to its threshold.
struct TwoStates {
  static constexpr int state_size = 2, guard_count = 1;
  using State = Eigen::Vector2d;
  using Jacobian = Eigen::Matrix2d;
  using Mode = wormdrive::Mode;
  struct Instant {
    double t{};
    State x = State::Zero();
    Mode mode{};
  };

  Constants constants;

  const test::events_two_state_model::State& in(Mode mode) const {
    return mode.motion == Motion::forward ? constants.up : constants.down;
  }
  State derivative(double, const State& y, Mode mode) const {
    return {constants.c1 * (y[1] + in(mode).c2 - y[0]), c3 * (in(mode).c4 - y[1])};
  }
  Jacobian jacobian(double, const State&, Mode) const {
    return (Jacobian() << -constants.c1, constants.c1, 0.0, -c3).finished();
  }
  std::array<Series<double, 1>, 1> guards_ahead(const Instant& now) const {
    Series<double, 1> left(in(now.mode).threshold - now.x[0]);
    left[1] = -derivative(now.t, now.x, now.mode)[0];
    if (now.mode.motion == Motion::backward) left = -left;
    return {left};
  }
  static std::string_view guard_name(Mode, int) { return "threshold"; }
  Instant jump(Instant now, int) const {
    now.mode.motion = now.mode.motion == Motion::forward ? Motion::backward : Motion::forward;
    return now;
  }
  Mode settle(const Instant& now) const {
    return now.mode.motion == Motion::stuck ? Mode{Motion::forward, Flank::none} : now.mode;
  }
  static bool at_rest(Mode) { return false; }
  void enter(double) {}
  bool command(double, double) { return false; }
  double next_knot(double) const { return std::numeric_limits<double>::infinity(); }
  double fastest_input(double) const { return 0.0; }
};

/// The two states s after constants were switched, by formula.
struct Solution {
  double c1;
  State in;
  double y1, y2;

  double second(double s) const { return in.c4 + (y2 - in.c4) * std::exp(-c3 * s); }
  double first(double s) const {
    const double slow = (y2 - in.c4) * c1 / (c1 - c3), fast = y1 - in.c4 - in.c2 - slow;
    return in.c4 + in.c2 + slow * std::exp(-c3 * s) + fast * std::exp(-c1 * s);
  }
  /// When y1 is at the threshold: once the fast part has died away there is only one such time.
  double passes(double longest) const {
    const double low = 50.0 / c1;
    const bool rises = in.threshold > first(low);
    return end_of(low, longest, [&](double s) { return (first(s) < in.threshold) == rises; });
  }
};

struct Exact {
  std::vector<double> times;
  double y1, y2;
};
Exact exact(const Constants& c, double end) {
  Exact found{{}, start_1, start_2};
  bool up = true;
  for (double t = 0.0;; up = !up) {
    const Solution part{c.c1, up ? c.up : c.down, found.y1, found.y2};
    const double s = part.passes(10.0), left = t + s < end ? s : end - t;
    found.y1 = part.first(left);
    found.y2 = part.second(left);
    if (t + s >= end) return found;
    found.times.push_back(t += s);
  }
}

/// Compares a run to an end with the formulas: every threshold's time, and the states there.
void compare(const Constants& c, By by, double relative, double end, double time_error, double state_error) {
  const Exact formula = exact(c, end);
  TwoStates system{c};
  CvodeSolver<TwoStates> solver(system, tight(by, relative));
  std::vector<double> times;
  Mode before{};
  const auto record = [&](const TwoStates&, const TwoStates::Instant& now) {
    if (before.motion != Motion::stuck && !(now.mode == before)) times.push_back(now.t);
    before = now.mode;
  };
  const auto last = simulate(system, solver, Timetable(0.0, end, 0.01), {0.0, {start_1, start_2}, {}}, record);
  REQUIRE(times.size() == formula.times.size());
  Deviation deviation, state;
  for (std::size_t k = 0; k < times.size(); ++k) deviation.add(times[k] - formula.times[k]);
  state.add(last.x[0] - formula.y1);
  state.add(last.x[1] - formula.y2);
  INFO(times.size() << " thresholds, largest deviation of their times " << deviation << " s, of the states " << state);
  CHECK(deviation <= time_error);
  CHECK(state <= state_error);
}

}  // namespace

TEST_CASE("ARGESIM C5, two stiff states: every threshold is passed when the formulas say") {
  const Exact formula = exact(comparison, 5.0);
  REQUIRE(formula.times.size() == 5);
  REQUIRE(std::abs(formula.times[0] - 1.1083061677711) <= 1e-12);
  REQUIRE(std::abs(formula.times[4] - 4.9999996462203) <= 1e-12);
  compare(comparison, bdf, 1e-6, 4.9, 1e-4, 1e-4);
  compare(comparison, bdf, 1e-10, 4.9, 1e-7, 1e-7);
  // 3.5e-7 s behind the last threshold y1 still falls by 2e6 a second
  compare(comparison, bdf, 1e-13, 5.0, 3e-10, 3e-4);
}

TEST_CASE("ARGESIM C5, switched often: none of 62 thresholds is lost") {
  REQUIRE(exact(frequent, 5.0).times.size() == 62);
  compare(frequent, bdf, 1e-10, 5.0, 1e-6, 1e-6);
}

TEST_CASE("ARGESIM C5 with a thousandth of its stiffness, which Adams can follow") {
  Constants softer = comparison;
  softer.c1 = 2.7e3;
  for (By by : {bdf, adams}) compare(softer, by, 1e-10, 4.9, 1e-7, 1e-7);
}

}  // namespace wormdrive::test::events_two_state_model
