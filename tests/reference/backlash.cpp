#include <cmath>

#include "catch.hpp"
#include "compliant_drives.hpp"

// ElastoBacklash of the Modelica Standard Library 4.1.0, computed by Dymola: 5 kg m^2 thrown to and fro between two
// elastic stops, 45 degrees apart. It is the gear of a worm that does not turn, with a lever arm of 1 m.

namespace wormdrive::test::reference_backlash {

namespace {

constexpr double J = 5.0, stiffness = 20e3, damping = 50.0, gap = 45 * unit::degree, start = 90 * unit::degree;

auto elasto_backlash() {
  return compliant(unit_arms(clamped_shaft, J), constant(0.0), constant(0.0),
                   {LimitedDamper<double>{stiffness, damping}, gap});
}

/// The same law in formulas of its own: 0 in the gap, 1 where the damper is limited, 2 where it is not.
int region(const std::array<double, 2>& x) {
  const double s = x[0] < 0.0 ? -1.0 : 1.0, elastic = stiffness * (s * x[0] - gap / 2), viscous = damping * s * x[1];
  if (elastic <= 0.0 || elastic + viscous <= 0.0) return 0;
  return viscous >= elastic ? 1 : 2;
}
std::array<double, 2> rate(double, const std::array<double, 2>& x) {
  const double s = x[0] < 0.0 ? -1.0 : 1.0, elastic = stiffness * (x[0] - s * gap / 2), viscous = damping * x[1];
  switch (region(x)) {
    case 1: return {x[1], -2.0 * elastic / J};
    case 2: return {x[1], -(elastic + viscous) / J};
  }
  return {x[1], 0.0};
}

}  // namespace

TEST_CASE("ElastoBacklash: angle and speed are Dymola's in every row", "[reference][slow]") {
  const auto dymola = reference("modelica/Backlash.csv");
  if (!dymola) return;
  Deviation angle, speed;
  decltype(elasto_backlash())::Instant now{0.0, {0.0, 0.0, start, 0.0}, {}};
  for (std::size_t row = 0; row < dymola->size(); ++row) {
    const double t = dymola->number("time", row);
    if (t > now.t) now = run(elasto_backlash(), Timetable(now.t, t, 1.0), now, tight(bdf, 1e-9)).end;
    angle.add(now.x[2] - dymola->number("elastoBacklash.phi_rel", row));
    speed.add(now.x[3] - dymola->number("elastoBacklash.w_rel", row));
  }
  INFO("largest deviation: angle " << angle << " rad, speed " << speed << " rad/s");
  REQUIRE(angle <= 5e-5);
  REQUIRE(speed <= 3e-3);
}

TEST_CASE("ElastoBacklash: the hybrid run is a fixed-step integration of the law at 1e-7 s, with its event times") {
  const double h = 1e-7;
  const auto ours = run(elasto_backlash(), Timetable(0, 1, 0.01), {0.0, {0.0, 0.0, start, 0.0}, {}}, tight(bdf, 1e-15));
  std::array<double, 2> x{start, 0.0};
  std::vector<double> bends, contacts;
  Deviation angle, speed, times;
  long step = 0;
  for (const auto& row : ours.rows) {
    const long k = std::lround(row.now.t / h);
    if (std::abs(row.now.t - static_cast<double>(k) * h) > 1e-15) continue;
    for (; step < k; ++step) {
      const bool was_free = region(x) == 0;
      const auto crossed = [&](double t, const auto&) { bends.push_back(t); };
      piecewise_step(rate, region, crossed, static_cast<double>(step) * h, x, h);
      if (was_free != (region(x) == 0)) contacts.push_back(bends.back());
    }
    angle.add(row.now.x[2] - x[0]);
    speed.add(row.now.x[3] - x[1]);
  }
  INFO("largest deviation: angle " << angle << " rad, speed " << speed << " rad/s");
  REQUIRE(step == 10'000'000);
  REQUIRE(angle <= 1e-9);
  REQUIRE(speed <= 1e-9);

  REQUIRE(contacts.size() == ours.events.size());
  for (std::size_t k = 0; k < contacts.size(); ++k) times.add(ours.events[k].after.t - contacts[k]);
  INFO(contacts.size() << " events, largest deviation of their times " << times << " s");
  REQUIRE(contacts.size() > 20);
  REQUIRE(times <= 1e-11);
}

}  // namespace wormdrive::test::reference_backlash
