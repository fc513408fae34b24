#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "compliant_drives.hpp"
#include "core/elastic/elastic_teeth.hpp"
#include "core/elastic/impact.hpp"
#include "description/build.hpp"
#include "diagnosis/fitting/gap_search.hpp"
#include "diagnosis/predictor/drive_with_backlash.hpp"
#include "diagnosis/recordings.hpp"

// Teeth with play as the predictor follows them: flights by hand, bounces against the drive with elastic teeth.

namespace wormdrive::test::diagnosis_backlash {

TEST_CASE("teeth that fly apart meet when a parabola says so") {
  // the gear falls away from the worm's left flank through 3 mrad to its right one
  const FreeFlight flight{ConstantAcceleration{-8.0}, ConstantAcceleration{2.0}, 0.0, 1.0};
  const auto impact = flight.impact(1.5e-3, 1.5e-3);
  REQUIRE(impact);
  CHECK(impact->flank == Flank::right);
  CHECK(std::abs(impact->after - std::sqrt(2.0 * 3e-3 / 10.0)) < 1e-15);
  CHECK(std::abs(impact->speed - std::sqrt(2.0 * 3e-3 * 10.0)) < 1e-14);
  CHECK_FALSE(FreeFlight{ConstantAcceleration{-8.0}, ConstantAcceleration{2.0}, 0.0, 0.02}.impact(1.5e-3, 1.5e-3));
}

TEST_CASE("teeth that have just bounced fly before they meet again") {
  const FreeFlight flight{ConstantAcceleration{5.0}, ConstantAcceleration{-5.0}, -0.02, 1.0};
  const auto impact = flight.impact(1e-3, 1e-3);
  REQUIRE(impact);
  CHECK(impact->flank == Flank::left);
  CHECK(std::abs(impact->after - 2.0 * 0.02 / 10.0) < 1e-15);
  CHECK(std::abs(impact->speed - 0.02) < 1e-15);
}

TEST_CASE("a drive with play follows the one whose stiff teeth bounce") {
  Samples held;
  for (int k = 0; k < 600; ++k) {
    held.times.push_back(0.001 * k);
    held.values.push_back(-0.05 * std::sin(3.0 * std::numbers::pi * 0.001 * k));
  }
  constexpr double gap = 2e-3, end = 0.6;
  const MeshParameters<double> p = table1();
  const auto rigid = drive(p, fig9_load(), {{held}});
  const double mass = effective_mass(rigid.mesh(), rigid.Jg());
  const ToothContact<double> contact{LimitedDamper<double>{1e8, 0.3 * std::sqrt(1e8 * mass)}, gap};
  const auto elastic = run(compliant(p, fig9_load(), {{held}}, contact), Timetable(0, end, 1e-3),
                           {0.0, {-p.i * gap / 2, 0.0, 0.0, 0.0}, {}}, tight(bdf, 1e-10));

  const auto follow = [&](double separation, const Restitution& impact) {
    DriveWithBacklash<GravityLoad> follower(rigid, separation, 0.0, impact);
    follower.drive().enter(0.0);
    auto now = follower.at(0.0, {0.0, 0.0});
    Deviation worst;
    std::size_t row = 0;
    for (int k = 1; k <= 600; ++k) {
      follower.drive().enter(0.001 * (k - 1));
      follower.run(now, 0.001 * k);
      while (row + 1 < elastic.rows.size() && elastic.rows[row].now.t < 0.001 * k - 1e-9) ++row;
      worst.add(now.now.x[0] - elastic.rows[row].now.x[2]);
    }
    return worst.size;
  };
  const double half_swing = std::numbers::pi / contact_frequency(contact, mass);
  CHECK(follow(gap, {restitution(contact, mass, 1.0), half_swing}) < 0.03 * gap);
  CHECK(follow(0.0, {}) > 0.3 * gap);
}

TEST_CASE("a scenario that gets backlash gets teeth that bounce as found") {
  Scenario arm = nominal_arm();
  give_teeth_for_impacts(arm, {0.6, 1e-3});
  CHECK_FALSE(std::get<std::optional<ToothCompliance<double>>>(arm.effects.list));
  set_field(arm.effects, {"backlash", "gap", 1e-3});
  give_teeth_for_impacts(arm, {0.6, 1e-3});
  const auto teeth = std::get<std::optional<ToothCompliance<double>>>(arm.effects.list);
  REQUIRE(teeth);
  CHECK(arm.run.solver == SolverKind::cvode);
  const GearMesh<double> mesh = stated_mesh(arm);
  const double mass = effective_mass(mesh, total_gear_inertia(arm));
  const ToothContact<double> contact = tooth_contact(arm.effects);
  CHECK(std::abs(restitution(contact, mass, 0.2) - 0.6) < 1e-3);
  CHECK(std::abs(std::numbers::pi / contact_frequency(contact, mass) - 1e-3) < 1e-9);
}

}  // namespace wormdrive::test::diagnosis_backlash
