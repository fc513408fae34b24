#include <cmath>
#include <random>

#include "catch.hpp"
#include "core/statics.hpp"
#include "support.hpp"

// A load that falls within days from what just holds the gear leaves it with an acceleration of nothing. Friction that
// falls over the speed carries it off all the same: what moves by less than an absolute tolerance is not at rest.

namespace wormdrive::test::events_creeping_start {

TEST_CASE("a gear that leaves rest by next to nothing is carried off by friction that falls", "[slow]") {
  std::mt19937_64 random(2026);
  const auto decades = [&](double low, double high) {
    return std::pow(10.0, std::uniform_real_distribution(low, high)(random));
  };
  for (int k = 0; k < 30; ++k) {
    MeshParameters<double> p = table1();
    const double size = decades(-3.0, 3.0), load = -size * decades(-2.0, 1.0), mu = p.mu;
    p.Jw *= size * decades(-1.0, 1.0);
    p.Jg *= size * decades(-1.0, 1.0);
    const GearMesh<double> mesh(p);
    const double hold = *break_in_torques(mesh, load).forward, drop = 0.1 * mu;
    // friction falls by a tenth over a gear speed that it gives the gear within 0.1 us to 0.1 s
    const double inertia = p.Jw * p.i + mesh.C2() * p.Jg;
    const double pull = std::abs((mesh.C2() - mesh.C(drop - mu)) * load) / inertia, takes = decades(-7.0, -1.0);
    // rounding hides the fall of the load for some 1e-8 periods
    const double period = takes * decades(8.0, 11.0), end = 1e4 * takes;
    Effects<double> effects;
    std::get<std::optional<Stribeck<double>>>(effects.list) =
        Stribeck<double>{.drop = drop, .speed = std::abs(mesh.sliding_speed(p.i * pull * takes))};
    const Signal falling{{Constant{0.8 * load}, Sinusoid{.amplitude = 0.2 * load, .frequency = 1.0 / period}}};
    for (const By by : every_solver) {
      auto settings = tight(by, 1e-12);
      settings.absolute_tolerance = 1e-14 * pull * takes;
      CAPTURE(k, size, load, hold, period, pull, takes, static_cast<int>(by.solver), static_cast<int>(by.method));
      const auto r =
          run(WormDrive(mesh, make_load(falling), effects, constant(hold)), Timetable(0.0, end, end), {}, settings);
      CHECK(r.events.size() < 10);  // again, where the first start is rounding
      CHECK(r.end.mode.motion == Motion::forward);
      CHECK(r.end.x[1] > pull * takes);
    }
  }
}

}  // namespace wormdrive::test::events_creeping_start
