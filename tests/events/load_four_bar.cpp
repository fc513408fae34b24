#include <cmath>
#include <numbers>

#include <ceres/jet.h>

#include "catch.hpp"
#include "events/flywheel.hpp"
#include "near_ties/dice.hpp"
#include "numbers.hpp"
#include "support.hpp"

// A linkage of four bars, against energy, and against the rocker's angle from its geometry by arcs alone.

namespace wormdrive::test::events_load_four_bar {

namespace {

using Linkage = LoadFourBar<double>;
using Jet = ceres::Jet<double, 1>;

Linkage drawn_linkage(near_ties::Dice& dice, double beside) {
  for (;;) {
    Linkage l;
    l.crank = dice.decades(1e-2, 1.0);
    l.coupler = l.crank * dice.decades(0.3, 8.0);
    l.rocker = l.crank * dice.decades(0.3, 8.0);
    l.base = l.crank * dice.decades(0.2, 8.0);
    if (l.clearance() < l.crank * dice.decades(0.01, 1.0)) continue;
    l.inertia = beside * dice.decades(0.1, 10.0);
    l.shift = dice.between(-3.0, 3.0);
    return l;
  }
}

/// The angle of the rocker: that from its pivot to the end of the crank, and the one between that line and the rocker.
Jet rocker(const Linkage& l, const Jet& theta_g) {
  const Jet p = theta_g + l.shift, dx = l.crank * cos(p) - l.base, dy = l.crank * sin(p);
  const Jet length = sqrt(dx * dx + dy * dy);
  return atan2(dy, dx) +
         acos((l.rocker * l.rocker + length * length - l.coupler * l.coupler) / (2.0 * l.rocker * length));
}
double inertia(const Linkage& l, double theta_g) {
  const double slope = rocker(l, Jet(theta_g, 0)).v[0];
  return l.inertia * slope * slope;
}

}  // namespace

TEST_CASE("a linkage has the inertia of its geometry, the slope of that, and no more than its greatest") {
  for (int trial = 0; trial < 200; ++trial) {
    near_ties::Dice dice(20261205, static_cast<std::uint64_t>(trial));
    const Linkage l = drawn_linkage(dice, 1.0);
    const double angle = dice.between(-6.0, 6.0), h = 1e-4 / l.ripple(1.0);
    INFO(trial << ": crank " << l.crank << ", coupler " << l.coupler << ", rocker " << l.rocker << ", base " << l.base);
    const VaryingInertia<double> found = l.inertia_at(angle);
    const double greatest = l.greatest_inertia();
    CHECK(std::abs(found.inertia - inertia(l, angle)) <= 1e-10 * greatest);
    const double slope = (8.0 * (inertia(l, angle + h) - inertia(l, angle - h)) -
                          (inertia(l, angle + 2.0 * h) - inertia(l, angle - 2.0 * h))) /
                         (12.0 * h);
    CHECK(std::abs(found.slope - slope) <= 1e-7 * greatest * l.ripple(1.0));
    CHECK(found.inertia <= greatest * (1.0 + 1e-3));
  }
}

TEST_CASE("a flywheel that swings a rocker turns as its energy says, by every solver") {
  check_energy_of_flywheels(20261206, drawn_linkage, inertia);
}

}  // namespace wormdrive::test::events_load_four_bar
