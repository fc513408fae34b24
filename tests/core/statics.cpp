#include "core/statics.hpp"

#include <cmath>
#include <vector>

#include <Eigen/LU>

#include "catch.hpp"
#include "support.hpp"

namespace wormdrive::test::core_statics {

namespace {

/// Eq. 6-7 as the paper states them, one flank at a time: the two balances at rest for Wn and Wf on that flank.
struct AtRest {
  double Wn, Wf;
};
AtRest solve_eq_6(const MeshParameters<double>& p, Flank flank, double tau_m, double tau_l) {
  const double c = std::cos(p.lambda), s = std::sin(p.lambda), n = sign(flank) * std::cos(p.phi_n);
  Eigen::Matrix2d A;
  A << n * s * p.lw, -c * p.lw,  //
      -n * c * p.lg, -s * p.lg;
  const Eigen::Vector2d W = A.fullPivLu().solve(Eigen::Vector2d(-tau_m, -tau_l));
  return {W[0], W[1]};
}

/// Eq. 8 on the flank that is pushed, Wn >= 0. How far inside the friction cone, over the size of its terms.
double margin_of_eq_8(const MeshParameters<double>& p, double tau_m, double tau_l) {
  const AtRest left = solve_eq_6(p, Flank::left, tau_m, tau_l), right = solve_eq_6(p, Flank::right, tau_m, tau_l);
  const AtRest pushed = left.Wn >= 0.0 ? left : right;
  return (p.mu * pushed.Wn - std::abs(pushed.Wf)) / (p.mu * pushed.Wn + std::abs(pushed.Wf) + 1e-300);
}

std::vector<double> spread(double low, double high, int count) {
  std::vector<double> values;
  for (int k = 0; k < count; ++k) values.push_back(low + (high - low) * k / (count - 1));
  return values;
}

}  // namespace

TEST_CASE("the two torque balances at rest are solved by the forces of the mesh") {
  const MeshParameters<double> p = table1();
  for (double tau_m : {-0.3, 0.0, 0.02})
    for (double tau_l : {-1.0, 0.3}) {
      const MeshForces forces = forces_at_rest(GearMesh<double>(p), tau_m, tau_l);
      const Flank flank = forces.normal > 0.0 ? Flank::left : Flank::right;
      const AtRest independent = solve_eq_6(p, flank, tau_m, tau_l);
      REQUIRE(independent.Wn > 0.0);
      REQUIRE(std::abs(std::abs(forces.normal) - independent.Wn) <= 1e-12 * independent.Wn);
      REQUIRE(std::abs(forces.friction - independent.Wf) <= 1e-12 * independent.Wn);
    }
}

TEST_CASE("what is released from rest agrees with the friction cone at 100000 points from drivable to nearly locked") {
  // mu_g is 13.44 and eq. 17 holds up to it; both regimes below it are crossed. Points closer to the edge of the cone
  // than rounding have no answer to compare, and none of this grid is.
  int points = 0, cone_differs = 0, settle_differs = 0, stuck = 0, on_the_edge = 0;
  for (double mu : spread(0.013, 13.3, 40)) {
    const MeshParameters<double> p = table1(mu);
    const GearMesh<double> mesh(p);
    REQUIRE(mesh.C1() > -mesh.Jw * mesh.i / mesh.Jg);
    for (double tau_m : spread(-1.0, 1.037, 50))
      for (double tau_l : spread(-1.511, 1.5, 50)) {
        ++points;
        const double margin = margin_of_eq_8(p, tau_m, tau_l);
        if (std::abs(margin) < 1e-12) ++on_the_edge;
        const bool released = entered(p, constant(tau_l), constant(tau_m)).settle({}).motion != Motion::stuck;
        if (sticks(mesh, tau_m, tau_l) != (margin >= 0.0)) ++cone_differs;
        if (released == (margin >= 0.0)) ++settle_differs;
        if (margin >= 0.0) ++stuck;
      }
  }
  REQUIRE(points == 100000);
  REQUIRE(on_the_edge == 0);
  REQUIRE(cone_differs == 0);
  REQUIRE(settle_differs == 0);
  REQUIRE((stuck > 10000 && stuck < 90000));
}

TEST_CASE("the stick region is the friction cone, inside out where the worm locks itself") {
  for (double mu : {0.03, 0.25, 5.0, 14.0, 30.0}) {
    const MeshParameters<double> p = table1(mu);
    const GearMesh<double> mesh(p);
    int differs = 0;
    for (double tau_l : spread(-1.51, 1.5, 101)) {
      const StickRegion region = stick_region(mesh, tau_l);
      for (double tau_m : spread(-8.0, 8.03, 401)) {
        const bool inside = region.low <= tau_m && tau_m <= region.high;
        if ((inside != region.outside) != sticks(mesh, tau_m, tau_l)) ++differs;
      }
    }
    REQUIRE(differs == 0);
  }
}

TEST_CASE("the break-in torques swap with the sign of the load") {
  const GearMesh<double> mesh(table1());
  const BreakInTorques lifted = break_in_torques(mesh, 0.69), pulled = break_in_torques(mesh, -0.69);
  REQUIRE(lifted.forward == -mesh.C1() * 0.69);
  REQUIRE(lifted.backward == -mesh.C2() * 0.69);
  REQUIRE(pulled.forward == mesh.C2() * 0.69);
  REQUIRE(pulled.backward == mesh.C1() * 0.69);
}

TEST_CASE("a drive at rest starts in the direction of the break-in torque that was passed, and ties stick") {
  const MeshParameters<double> p = table1();
  const GearMesh<double> mesh(p);
  for (double tau_l : {0.69, -0.69}) {
    const StickRegion region = stick_region(mesh, tau_l);
    const auto starts = [&](double tau_m) {
      REQUIRE(release_direction(mesh, tau_m, tau_l) == entered(p, constant(tau_l), constant(tau_m)).settle({}).motion);
      return release_direction(mesh, tau_m, tau_l);
    };
    REQUIRE(starts(region.high * (1.0 + 1e-12)) == Motion::forward);
    REQUIRE(starts(region.low * (1.0 + 1e-12)) == Motion::backward);
    REQUIRE(starts(0.5 * (region.high + region.low)) == Motion::stuck);
    REQUIRE(release_direction(mesh, region.high, tau_l) == Motion::stuck);
    REQUIRE(release_direction(mesh, region.low, tau_l) == Motion::stuck);
  }
}

TEST_CASE("a worm that locks itself is moved by no torque without load, and only inside the wedge with one") {
  const GearMesh<double> mesh(table1(14.0));
  REQUIRE(mesh.regime() == LockingRegime::worm_self_locking);
  for (double tau_m : {-100.0, -1e-3, 0.0, 1e-3, 100.0}) REQUIRE(sticks(mesh, tau_m, 0.0));
  for (double tau_l : {1.0, -1.0}) {
    const StickRegion wedge = stick_region(mesh, tau_l);
    REQUIRE(wedge.outside);
    REQUIRE_FALSE(sticks(mesh, 0.5 * (wedge.low + wedge.high), tau_l));
    REQUIRE(sticks(mesh, wedge.low - 1e-6, tau_l));
    REQUIRE(sticks(mesh, wedge.high + 1e-6, tau_l));
    REQUIRE_FALSE(break_in_torques(mesh, tau_l).forward.has_value());
    REQUIRE_FALSE(break_in_torques(mesh, tau_l).backward.has_value());
  }
}

TEST_CASE("efficiencies of a geometry that closes are those of a screw with a trapezoidal thread") {
  for (double mu : {0.0, 0.03, 0.25}) {
    const MeshParameters<double> p = closing(table1(mu));
    const GearMesh<double> mesh(p);
    const double tan = std::tan(p.lambda), cos_phi = std::cos(p.phi_n);
    const double forward = (cos_phi - mu * tan) / (cos_phi + mu / tan);
    const double backward = (cos_phi - mu / tan) / (cos_phi + mu * tan);
    REQUIRE(std::abs(forward_efficiency(mesh) - forward) <= 1e-14);
    REQUIRE(std::abs(backward_efficiency(mesh) - backward) <= 1e-14);
    REQUIRE((backward_efficiency(mesh) < 0.0) == (mesh.regime() != LockingRegime::back_drivable));
  }
  REQUIRE(forward_efficiency(GearMesh<double>(table1(14.0))) == 0.0);
}

}  // namespace wormdrive::test::core_statics
