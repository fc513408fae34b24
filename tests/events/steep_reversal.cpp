#include <cmath>
#include <random>

#include "catch.hpp"
#include "support.hpp"

// After weeks a time is known to nanoseconds, and friction may fall within less: then nothing that happens just after a
// reversal can be told by the clock. The gear turns once all the same, and goes on.

namespace wormdrive::test::events_steep_reversal {

TEST_CASE("a reversal whose friction falls within less than time resolves happens once") {
  std::mt19937_64 random(2026);
  const auto decades = [&](double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution(low, high)(random));
  };
  for (int k = 0; k < 40; ++k) {
    const double begin = decades(3.0, 8.0), resolution = time_resolution(begin);
    const double torque = decades(-2.0, 2.0), load = -torque * decades(-1.0, 1.0);
    MeshParameters<double> p = table1();
    // the acceleration that both torques give without friction, roughly
    const double acceleration = torque / (p.Jw * p.i), slow = acceleration * resolution * decades(-3.0, 0.0);
    Effects<double> effects;
    std::get<std::optional<Stribeck<double>>>(effects.list) = Stribeck<double>{.drop = 0.1, .speed = p.lw * p.i * slow};
    const double speed = acceleration * 1e3 * resolution;
    for (const By by : every_solver) {
      CAPTURE(k, begin, torque, load, slow, static_cast<int>(by.solver), static_cast<int>(by.method));
      WormDrive d(GearMesh<double>(p), make_load(constant(load)), effects, constant(torque));
      WormDrive<double, TimedLoad>::Instant from;
      from.t = begin;
      from.x = {0.0, -speed};
      const auto r = run(d, Timetable(begin, begin + 1e5 * resolution, 1e5 * resolution), from, tight(by, 1e-12));
      int turns = 0;
      for (const auto& event : r.events) turns += event.before.mode.motion != event.after.mode.motion;
      CHECK(turns == 1);
      CHECK(r.end.mode.motion == Motion::forward);
    }
  }
}

}  // namespace wormdrive::test::events_steep_reversal
