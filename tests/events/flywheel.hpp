#pragma once
#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "core/energy.hpp"
#include "near_ties/dice.hpp"
#include "numbers.hpp"
#include "support.hpp"

namespace wormdrive::test {

/// Turns flywheels of every size that move something whose inertia depends on the angle, and asks that they turn as
/// their energy says. drawn(dice, J): an effect beside an inertia J; inertia(effect, angle): what it adds by a judge.
template <class Drawn, class Inertia>
void check_energy_of_flywheels(std::uint64_t seed, const Drawn& drawn, const Inertia& inertia) {
  for (int trial = 0; trial < 20; ++trial) {
    near_ties::Dice dice(seed, static_cast<std::uint64_t>(trial));
    const double J = dice.decades(1e-5, 1e2), speed = dice.sign() * dice.decades(1e-2, 1e3),
                 turns = dice.decades(0.3, 3.0), end = 2.0 * std::numbers::pi * turns / std::abs(speed);
    const auto effect = drawn(dice, J);
    const double energy = (J + inertia(effect, 0.1)) * speed * speed;
    for (const By by : every_solver) {
      INFO(trial << " by " << static_cast<int>(by.solver) << static_cast<int>(by.method));
      const WormDrive<double, TimedLoad> d(GearMesh<double>::without_teeth(J), make_load(Signal{}), effects(effect),
                                           Signal{});
      const auto seen = run(d, Timetable(0, end, end / 20.0), {0.0, {0.1, speed}, {}}, tight(by));
      Deviation off;
      for (const auto& row : seen.rows) {
        const double omega = row.now.x[1];
        off.add((J + inertia(effect, row.now.x[0])) * omega * omega / energy - 1.0);
        REQUIRE(close(2.0 * stored_energy(d, row.now), energy, 1e-9));
      }
      CHECK(off <= (by.solver == SolverKind::cvode && by.method == Method::bdf ? 1e-9 : 1e-10));
    }
  }
}

}  // namespace wormdrive::test
