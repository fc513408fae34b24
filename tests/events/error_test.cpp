#include <cmath>
#include <numbers>
#include <random>

#include "catch.hpp"
#include "core/statics.hpp"
#include "support.hpp"

// CVODE's error test where it fails again and again: at friction that changes within a millionth of a long step, and
// where the tolerance is finer than the rounding of the torques.

namespace wormdrive::test::events_error_test {
namespace {

/// The modes that the solvers go through, which must be those of taylor.
template <class Drive>
std::size_t changes_as_taylor(Drive& d, const Timetable& times, double absolute_tolerance) {
  std::vector<std::vector<Mode>> modes;
  for (const By by :
       {By{SolverKind::taylor}, By{SolverKind::cvode, Method::bdf}, By{SolverKind::cvode, Method::adams}}) {
    auto settings = tight(by, 1e-12);
    settings.absolute_tolerance = absolute_tolerance;
    CAPTURE(static_cast<int>(by.solver), static_cast<int>(by.method));
    try {
      modes.push_back(run(d, times, {}, settings).modes());
    } catch (const SimulationFailure& failure) {
      FAIL_CHECK(failure.what());
      continue;
    }
    CHECK(modes.back() == modes.front());
  }
  return modes.front().size();
}

}  // namespace

TEST_CASE("a gear that stops after days through friction that falls within nanometres a second") {
  std::mt19937_64 random(2026);
  const auto decades = [&](double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution(low, high)(random));
  };
  std::size_t changes = 0;
  for (int k = 0; k < 40; ++k) {
    MeshParameters<double> p = table1(decades(-1.5, -0.5));
    const double size = decades(-2.0, 2.0), period = decades(3.0, 6.0);
    p.Jw *= size * decades(-1.0, 1.0);
    p.Jg *= size * decades(-1.0, 1.0);
    const double drop = p.mu * decades(-1.0, -0.5), speed = decades(-9.0, -6.0);
    CAPTURE(k, p.mu, size, period, drop, speed);
    auto d = drive(p, constant(0.3 * size), Signal{{Sinusoid{0.5 * size, 1.0 / period, decades(-1.0, 0.5)}}},
                   effects(Stribeck<double>{.drop = drop, .speed = speed}));
    changes += changes_as_taylor(d, Timetable(0.0, 1.7 * period, 0.1 * period), 1e-14 / period);
  }
  CHECK(changes > 40 * 3);
}

TEST_CASE("a tolerance below the rounding of torques that all but balance asks for no more than there is") {
  std::mt19937_64 random(331);
  const auto decades = [&](double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution(low, high)(random));
  };
  for (int k = 0; k < 12; ++k) {
    MeshParameters<double> p = table1(decades(-1.5, -0.5));
    const double size = decades(-2.0, 2.0), period = decades(3.0, 5.0), excess = decades(-12.0, -10.0);
    p.Jw *= size * decades(-1.0, 1.0);
    p.Jg *= size * decades(-1.0, 1.0);
    // motor and load in phase, each at all times a little more than the one that the other just holds
    const double hold = *break_in_torques(GearMesh<double>(p), -size).forward, phase = decades(-1.0, 0.0);
    const auto wave = [&](double amplitude) { return Signal{{Sinusoid{amplitude, 1.0 / period, phase}}}; };
    CAPTURE(k, p.mu, size, period, excess, phase);
    auto d = drive(p, wave(-size), wave(hold * (1.0 + excess)));
    const auto r = run(d, Timetable(0.0, 0.2 * period, 0.1 * period), {}, [&] {
      auto settings = tight(By{SolverKind::cvode, Method::bdf}, 1e-12);
      settings.absolute_tolerance = 1e-14 / period;
      return settings;
    }());
    CAPTURE(r.statistics.steps);
    CHECK(r.statistics.steps < 100'000);
  }
}

}  // namespace wormdrive::test::events_error_test
