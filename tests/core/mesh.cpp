#include "core/mesh.hpp"

#include <cmath>
#include <set>
#include <string>

#include "catch.hpp"
#include "support.hpp"

namespace wormdrive::test::core_mesh {

TEST_CASE("Table 1 gives the coefficients that the paper prints, to its four decimals") {
  const GearMesh<double> mesh(table1());
  const double half_a_digit = 0.5e-4;
  REQUIRE(std::abs(mesh.C1() - -0.0471) <= half_a_digit);
  REQUIRE(std::abs(mesh.C2() - 0.0837) <= half_a_digit);
  REQUIRE(std::abs(mesh.H() - 3.4957) <= half_a_digit);
  REQUIRE(std::abs(mesh.mu_w() - 0.0657) <= half_a_digit);
  REQUIRE(std::abs(mesh.mu_g() - 13.4382) <= half_a_digit);
}

TEST_CASE("the locking regime includes both of its ends in gear self-locking") {
  const GearMesh<double> mesh(table1());
  const auto regime_at = [](double mu) { return GearMesh<double>(table1(mu)).regime(); };
  REQUIRE(regime_at(0.0) == LockingRegime::back_drivable);
  REQUIRE(regime_at(std::nextafter(mesh.mu_w(), 0.0)) == LockingRegime::back_drivable);
  REQUIRE(regime_at(mesh.mu_w()) == LockingRegime::gear_self_locking);
  REQUIRE(regime_at(0.25) == LockingRegime::gear_self_locking);
  REQUIRE(regime_at(mesh.mu_g()) == LockingRegime::gear_self_locking);
  REQUIRE(regime_at(std::nextafter(mesh.mu_g(), 14.0)) == LockingRegime::worm_self_locking);
}

TEST_CASE("the signs of C1 and C2 name the regime") {
  const GearMesh<double> drivable(table1(0.03)), gear_locks(table1(0.25)), worm_locks(table1(14.0));
  REQUIRE((drivable.C1() > 0.0 && drivable.C2() > 0.0));
  REQUIRE((gear_locks.C1() < 0.0 && gear_locks.C2() > 0.0));
  REQUIRE((worm_locks.C1() < 0.0 && worm_locks.C2() < 0.0));
}

TEST_CASE("without friction a geometry that closes multiplies the torque by exactly its ratio") {
  for (double i : {5.0, 30.0, 60.0, 200.0}) {
    MeshParameters<double> p = table1(0.0);
    p.i = i;
    const GearMesh<double> mesh(closing(p));
    REQUIRE(std::abs(mesh.closing_ratio() / i - 1.0) <= 1e-15);
    REQUIRE(std::abs(mesh.C(0.0) * i - 1.0) <= 1e-15);
    REQUIRE(std::abs(mesh.C1() - mesh.C2()) == 0.0);
  }
}

TEST_CASE("the printed Table 1 does not close: its radii and lead angle mean a ratio of 58.5, not 60") {
  const GearMesh<double> mesh(table1(0.0));
  REQUIRE(std::abs(mesh.closing_ratio() - 58.50) <= 0.005);
  REQUIRE(std::abs(mesh.closing_lead_angle() / unit::degree - 3.9005) <= 0.5e-4);
  REQUIRE(std::abs(mesh.C(0.0) * mesh.i - 1.0256) <= 0.5e-4);
}

TEST_CASE("C is the ratio of the two lever arms of the normal force, whatever the friction") {
  const GearMesh<double> mesh(table1());
  for (double m : {-13.0, -0.25, 0.0, 0.25, 13.0})
    REQUIRE(std::abs(mesh.C(m) * mesh.gear_arm(m) - mesh.worm_arm(m)) <= 1e-16);
}

TEST_CASE("the teeth slide along the helix: sliding speed is the worm's surface speed over cos lambda") {
  const MeshParameters<double> p = table1();
  const GearMesh<double> mesh(p);
  const double along_worm = p.lw * 100.0, along_axis = along_worm * std::tan(p.lambda);
  REQUIRE(std::abs(mesh.sliding_speed(100.0) - std::hypot(along_worm, along_axis)) <= 1e-15);
}

TEST_CASE("without teeth there is one inertia and every friction passes the torques on unchanged") {
  const auto mesh = GearMesh<double>::without_teeth(0.75);
  REQUIRE_FALSE(mesh.has_teeth);
  for (double m : {-0.3, 0.0, 2.0}) {
    REQUIRE(mesh.C(m) == 1.0);
    REQUIRE(mesh.Jw * mesh.i + mesh.C(m) * mesh.Jg == 0.75);
  }
  REQUIRE(mesh.mu == 0.0);
}

TEST_CASE("every parameter of the mesh is described once and its bounds refuse what is no worm gear") {
  std::set<std::string> names;
  std::set<std::string> refused;
  for_each_field<MeshParameters<double>>([&](const auto& field) {
    REQUIRE(names.insert(std::string(field.name)).second);
    REQUIRE(field.bounds.contain(table1().*field.member));
    if (!field.bounds.contain(0.0)) refused.insert(std::string(field.name));
    REQUIRE_FALSE(field.bounds.contain(-1.0));
  });
  REQUIRE(names.size() == 8);
  REQUIRE(refused == std::set<std::string>{"ratio", "lead_angle", "worm_pitch_radius", "gear_pitch_radius",
                                           "worm_inertia", "gear_inertia"});
}

}  // namespace wormdrive::test::core_mesh
