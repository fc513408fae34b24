#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "catch.hpp"
#include "events/torque_ratio.hpp"
#include "near_ties/dice.hpp"
#include "numbers.hpp"
#include "support.hpp"

// A locked gear whose motor torque, behind a winding or a current loop, rises just to break-in or just not. At rest
// that torque is a lag of the command in closed form, whatever winding and loop are, so its crest is known to the last
// digits.

namespace wormdrive::test::events_ties_with_states {

namespace {

/// y' = rate (u - y) from 0 at t = 0, u = level + amplitude cos(omega t + phase).
struct Lag {
  double rate, level, amplitude, omega, phase;

  double u(double t) const { return level + amplitude * std::cos(omega * t + phase); }
  double operator()(double t) const {
    const double x = omega * t + phase, share = amplitude * rate / (rate * rate + omega * omega);
    const double start = level + share * (rate * std::cos(phase) + omega * std::sin(phase));
    return level + share * (rate * std::cos(x) + omega * std::sin(x)) - start * std::exp(-rate * t);
  }
  /// Where side * y is largest of all its crests before an end.
  std::optional<double> crest(double side, double end) const {
    const auto rises = [&](double t) { return side * (u(t) - (*this)(t)) > 0.0; };
    const double step = 0.05 / std::max(rate, omega);
    std::optional<double> best;
    for (double t = step; t + step < end; t += step) {
      if (!rises(t) || rises(t + step)) continue;
      const double here = end_of(t, t + step, rises);
      if (!best || side * (*this)(here) > side * (*this)(*best)) best = here;
    }
    return best;
  }
};

/// A motor whose torque at rest follows the command at a rate, by its winding or by a loop around its current.
DcMotor<double> motor(near_ties::Dice& dice, double rate) {
  DcMotor<double> m;
  m.resistance = dice.decades(0.1, 10.0);
  m.torque_constant = dice.decades(0.01, 1.0);
  m.inductance = m.resistance / rate;
  if (dice.chance(0.5)) {
    m.inductance = *m.inductance * dice.decades(0.1, 10.0);
    m.current_bandwidth = rate / (2.0 * std::numbers::pi);
  }
  return m;
}

}  // namespace

TEST_CASE("a torque behind a winding that just reaches break-in, or just does not, is judged alike by every solver") {
  int broke_away = 0, held = 0;
  for (std::uint64_t trial = 0; trial < 180; ++trial) {
    near_ties::Dice dice(20261127, trial);
    MeshParameters<double> p = table1();
    p.mu = dice.between(0.08, 0.4);  // the gear locks itself
    const double side = dice.sign(), load = dice.decades(1e-3, 100.0), tau_l = side * dice.sign() * load;
    const auto break_in = [&](double way) { return -torque_ratio(p, way * tau_l > 0.0 ? p.mu : -p.mu) * tau_l; };
    const double rate = dice.decades(10.0, 1e5), omega = rate * dice.decades(1e-2, 1e2), end = 20.0 / omega;
    Lag lag{rate, dice.between(-0.7, 0.7), 1.0, omega, dice.between(-3.0, 3.0)};
    const auto crest = lag.crest(side, end);
    if (!crest || side * lag(*crest) <= 0.0) continue;
    const double excess = dice.chance(0.2) ? 0.0 : dice.sign() * dice.decades(1e-15, 1e-4);
    const double scale = break_in(side) * (1.0 + excess) / lag(*crest);
    lag.level *= scale;
    lag.amplitude *= scale;
    // on its way the torque is no larger anywhere else, and the other way well within what holds
    const auto trough = lag.crest(-side, end);
    const double least = std::min({0.0, side * lag(end), trough ? side * lag(*trough) : 0.0});
    if (side * lag(end) > side * lag(*crest) || -least > 0.9 * std::abs(break_in(-side))) continue;

    Effects<double> on = effects(motor(dice, rate));
    if (dice.chance(0.4))
      std::get<std::optional<WormLuGre<double>>>(on.list) =
          WormLuGre<double>{.coulomb_torque = dice.decades(1e-3, 1.0) * std::abs(break_in(side)),
                            .stiffness = dice.decades(0.1, 10.0) * std::abs(break_in(side))};
    const Signal command{{Constant{lag.level}, Sinusoid{lag.amplitude, omega / (2.0 * std::numbers::pi), lag.phase}}};
    for (const By by : every_solver) {
      INFO(trial << " by " << static_cast<int>(by.solver) << static_cast<int>(by.method) << ", excess " << excess);
      const auto seen = run(drive_with_states(GearMesh<double>(p), constant(tau_l), command, on),
                            Timetable(0, end, end / 20.0), {}, tight(by));
      // what a solver errs by decides nearer ties, one way or the other
      if (std::abs(excess) > 1e-9) CHECK(seen.events.empty() == (excess < 0.0));
      (seen.events.empty() ? held : broke_away) += 1;
      if (seen.events.empty()) continue;
      const auto& away = seen.events.front();
      CHECK(away.before.mode.motion == Motion::stuck);
      CHECK(sign(away.after.mode.motion) == side);
      CHECK(std::abs(lag(away.before.t) - break_in(side)) <= 1e-9 * std::abs(break_in(side)));
    }
  }
  REQUIRE(broke_away > 100);
  REQUIRE(held > 100);
}

}  // namespace wormdrive::test::events_ties_with_states
