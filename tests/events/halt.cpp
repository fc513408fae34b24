#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <fmt/format.h>

#include "catch.hpp"
#include "support.hpp"

// Runs that cannot go on, and the words in which they say so.

namespace wormdrive::test::events_halt {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

/// What a hybrid system without inputs and without a state of rest needs no thought for.
struct Autonomous {
  using Mode = wormdrive::Mode;
  void enter(double) {}
  bool command(double, double) { return false; }
  double next_knot(double) const { return never; }
  double fastest_input(double) const { return 0.0; }
  static bool at_rest(Mode) { return false; }
};

/// A ball that loses part of its speed at every bounce: its bounces accumulate at a finite time.
struct BouncingBall : Autonomous {
  static constexpr int state_size = 2, guard_count = 1;
  using State = Eigen::Vector2d;
  using Jacobian = Eigen::Matrix2d;
  struct Instant {
    double t{};
    State x = State::Zero();
    Mode mode{};
  };
  double restitution = 0.9;

  State derivative(double, const State& x, Mode) const { return {x[1], -9.81}; }
  Jacobian jacobian(double, const State&, Mode) const { return Jacobian{{0.0, 1.0}, {0.0, 0.0}}; }
  std::array<Series<double, 1>, 1> guards_ahead(const Instant& now) const {
    Series<double, 1> height(now.x[0]);
    height[1] = now.x[1];
    return {height};
  }
  static std::string_view guard_name(Mode, int) { return "floor"; }
  Mode settle(const Instant&) const { return {Motion::forward, Flank::none}; }
  Instant jump(Instant now, int) const {
    now.x = State(0.0, -restitution * now.x[1]);
    return now;
  }
};

/// A relay between two thresholds that are next to nothing apart.
struct Relay : Autonomous {
  static constexpr int state_size = 1, guard_count = 2;
  using State = Eigen::Matrix<double, 1, 1>;
  using Jacobian = State;
  struct Instant {
    double t{};
    State x = State::Zero();
    Mode mode{};
  };
  double threshold = 1e-10;

  State derivative(double, const State&, Mode mode) const { return State(sign(mode.motion)); }
  Jacobian jacobian(double, const State&, Mode) const { return Jacobian::Zero(); }
  std::array<Series<double, 1>, 2> guards_ahead(const Instant& now) const {
    Series<double, 1> left(threshold - sign(now.mode.motion) * now.x[0]), idle(1.0);
    left[1] = -1.0;
    if (now.mode.motion == Motion::forward) return {left, idle};
    return {idle, left};
  }
  static std::string_view guard_name(Mode, int guard) { return guard == 0 ? "upper threshold" : "lower threshold"; }
  Mode settle(const Instant&) const { return {Motion::forward, Flank::none}; }
  Instant jump(Instant now, int guard) const {
    now.mode.motion = guard == 0 ? Motion::backward : Motion::forward;
    return now;
  }
};

/// A load that stops being a number at a time.
struct FailingLoad {
  double fails = never;

  double inertia() const { return 0.0; }
  void enter(double) {}
  double next_knot(double) const { return never; }
  double fastest() const { return 0.0; }
  double ripple() const { return 1.0; }
  template <class S>
  S torque(const Moment<S>& at) const {
    using std::cos;
    if (at.t > S(fails)) return S(std::numeric_limits<double>::quiet_NaN());
    return 0.0196 * cos(at.theta_g);
  }
};

/// Runs until it halts and returns what was said; times collects when a guard fired.
template <class System>
std::string halt_of(System system, const Timetable& timetable, typename System::Instant from,
                    std::vector<double>* times = nullptr, ChatterLimit limit = {}, By method = adams) {
  CvodeSolver<System> solver(system, tight(method));
  double last = never;
  const auto record = [&](const System&, const typename System::Instant& now) {
    if (times && now.t == last) times->push_back(now.t);
    last = now.t;
  };
  try {
    simulate(system, solver, timetable, from, record, limit);
  } catch (const SimulationFailure& halt) {
    return halt.what();
  }
  return "no halt";
}

}  // namespace

TEST_CASE("a ball whose bounces accumulate stops with window, guard, modes and likely cause") {
  std::vector<double> bounces;
  const std::string text = halt_of(BouncingBall{}, Timetable(0, 100, never), {0.0, {1.0, 0.0}, {}}, &bounces,
                                   ChatterLimit{.events = 20, .window = 1e-4});
  REQUIRE(bounces.size() > 100);
  // the bounce that was too many stops the run before it is recorded; its time stands in the text alone
  const std::size_t from = text.find(" and ") + 5;
  const double last = std::stod(text.substr(from));
  REQUIRE(last > bounces.back());
  REQUIRE(last - bounces[bounces.size() - 19] < 1e-4);
  REQUIRE(text == fmt::format("chatter: 20 events between {:.12g} and {} s, the last at guard 'floor' from forward to "
                              "forward; this guard's crossings accumulate: a rest state that the model cannot hold, or "
                              "a guard that does not become positive after its own event",
                              bounces[bounces.size() - 19], text.substr(from, text.find(" s,") - from)));
}

TEST_CASE("two modes that lead straight into each other stop with the guards that take turns") {
  const std::string text = halt_of(Relay{}, Timetable(0, 1, never), {});
  const std::string last = text.substr(text.find(" and ") + 5, text.find(" s,") - text.find(" and ") - 5);
  REQUIRE(text.substr(0, 28) == "chatter: 100 events between ");
  REQUIRE(std::stod(last) < 1e-6);
  REQUIRE(text.substr(text.find(" s,")) ==
          " s, the last at guard 'upper threshold' from forward to backward; guards take turns without motion between "
          "them: the two modes each lead straight into the other");
}

TEST_CASE("as many events as the limit allows in a window pass, one more does not") {
  const Mode left{Motion::forward, Flank::left}, right{Motion::forward, Flank::right};
  EventLog log(ChatterLimit{.events = 3, .window = 1e-6});
  for (double t : {0.5, 0.5, 0.5}) log.count(t, "switching surface", left, right);
  std::string text;
  try {
    log.count(0.5000005, "gear speed", right, Mode{});
  } catch (const SimulationFailure& halt) {
    text = halt.what();
  }
  REQUIRE(text ==
          "chatter: 3 events between 0.5 and 0.5000005 s, the last at guard 'gear speed' from forward, right "
          "flank to stuck; guards take turns without motion between them: the two modes each lead straight "
          "into the other");
  EventLog slow(ChatterLimit{.events = 3, .window = 1e-6});
  for (int k = 0; k < 1000; ++k) REQUIRE_NOTHROW(slow.count(k * 0.6e-6, "gear speed", left, right));
}

TEST_CASE("a load that becomes no number stops a moving drive with time, mode and latest events") {
  using Drive = WormDrive<double, FailingLoad>;
  for (By method : every_solver) {
    const std::string text = halt_of(Drive(GearMesh<double>(table1()), FailingLoad{0.65}, {}, fig9_motor()),
                                     Timetable(0, 2, never), {}, nullptr, {}, method);
    const std::string lead = "cannot go on at t = ";
    const std::size_t rest = text.find(" s,");
    REQUIRE(text.substr(0, lead.size()) == lead);
    const double t = std::stod(text.substr(lead.size(), rest - lead.size()));
    REQUIRE((t > 0.6 && t <= 0.65));  // as far as the solver came, not where it was last asked to report
    REQUIRE(text.substr(rest) ==
            " s, forward, right flank, after 3 events (the last: backward break-in at "
            "0.00348121391 s, switching surface at 0.361272998 s, gear speed at 0.595195013 s): "
            "the acceleration is not a finite number");
  }
}

TEST_CASE("a load that becomes no number stops a drive at rest too") {
  using Drive = WormDrive<double, FailingLoad>;
  REQUIRE(halt_of(Drive(GearMesh<double>(table1()), FailingLoad{0.65}, {}, constant(0.0)), Timetable(0, 2, 0.25), {}) ==
          "cannot go on at t = 0.5 s, stuck, before any event: a guard of the state of rest is not a finite number");
}

TEST_CASE("a mode is described by its motion and, where there are teeth, its flank") {
  REQUIRE(describe({}) == "stuck");
  REQUIRE(describe({Motion::forward, Flank::left}) == "forward, left flank");
  REQUIRE(describe({Motion::backward, Flank::right}) == "backward, right flank");
  REQUIRE(describe({Motion::backward, Flank::none}) == "backward");
}

}  // namespace wormdrive::test::events_halt
