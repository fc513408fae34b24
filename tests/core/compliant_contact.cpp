#include <cmath>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "compliant_drives.hpp"
#include "core/elastic/impact.hpp"

// Contact and free flight of the compliant drive against closed forms.

namespace wormdrive::test::core_compliant_contact {

namespace {

constexpr double k = 1e6;  // [N/m]

/// Table 1 without friction and with the lead angle that its ratio needs.
MeshParameters<double> frictionless() { return closing(table1(0.0)); }

auto thrown(const MeshParameters<double>& p, const ContactLaw<double>& law, double backlash) {
  return compliant(p, constant(0.0), constant(0.0), {law, backlash});
}

/// Squared angular frequency of two bodies on one spring, k a_g (a_g/Jg + a_w/(i Jw)) [1/s^2].
double squared_frequency(const GearMesh<double>& mesh) {
  const double a_g = mesh.gear_arm(0.0), a_w = mesh.worm_arm(0.0);
  return k * a_g * (a_g / mesh.Jg + a_w / (mesh.i * mesh.Jw));
}
/// What the teeth cannot change: their torques are a_w Wn and -a_g Wn.
template <class Instant>
double momentum(const GearMesh<double>& mesh, const Instant& now) {
  return mesh.gear_arm(0.0) * mesh.Jw * now.x[1] + mesh.worm_arm(0.0) * mesh.Jg * now.x[3];
}
template <class Instant>
double kinetic(const GearMesh<double>& mesh, const Instant& now) {
  return 0.5 * (mesh.Jw * now.x[1] * now.x[1] + mesh.Jg * now.x[3] * now.x[3]);
}

}  // namespace

TEST_CASE("an undamped contact lasts half a period, and its force is a half sine with the closed form's peak") {
  const GearMesh<double> mesh(frictionless());
  const double omega = std::sqrt(squared_frequency(mesh)), b = 1e-3, approach = 0.5;  // gear against worm [rad/s]
  for (const double side : {1.0, -1.0}) {
    const auto r = run(thrown(frictionless(), HuntCrossley<double>{k, 0.0}, b), Timetable(0, 0.01, 1e-5),
                       {0.0, {0.0, 0.0, 0.0, side * approach}, {}});
    REQUIRE(r.events.size() >= 2);
    const double touch = r.events[0].after.t, open = r.events[1].after.t;
    REQUIRE(r.events[0].after.mode.contact == (side > 0 ? Flank::left : Flank::right));
    REQUIRE(std::abs(touch - b / 2 / approach) <= 1e-12);
    REQUIRE(std::abs(open - touch - std::numbers::pi / omega) <= 1e-11);
    const double peak = k * mesh.gear_arm(0.0) * approach / omega;
    Deviation force;
    for (const auto& row : r.rows)
      if (row.now.t >= touch && row.now.t <= open)
        force.add((row.seen.normal_force - peak * std::sin(omega * (row.now.t - touch))) / peak);
    REQUIRE(force <= 1e-9);
  }
}

TEST_CASE("in the gap each shaft follows its own torque") {
  const auto p = frictionless();
  const double tau_m = 1e-4, tau_l = 2e-3, t = 0.01;
  const auto end = run(compliant(p, constant(tau_l), constant(tau_m), {HuntCrossley<double>{k, 0.0}, 1.0}),
                       Timetable(0, t, 1.0), {0.0, {0.1, 2.0, 0.0, -0.5}, {}})
                       .end;
  REQUIRE(end.mode.contact == Flank::none);
  REQUIRE(close(end.x[1] - 2.0, tau_m * t / p.Jw, 1e-11));
  REQUIRE(close(end.x[3] + 0.5, tau_l * t / p.Jg, 1e-11));
  REQUIRE(close(end.x[0], 0.1 + 2.0 * t + 0.5 * tau_m / p.Jw * t * t, 1e-12));
  REQUIRE(close(end.x[2], -0.5 * t + 0.5 * tau_l / p.Jg * t * t, 1e-11));
}

TEST_CASE("momentum and energy survive a thousand undamped impacts", "[slow]") {
  const GearMesh<double> mesh(frictionless());
  const auto r = run(thrown(frictionless(), HuntCrossley<double>{k, 0.0}, 1e-3), Timetable(0, 4.2, 10.0),
                     {0.0, {0.0, 1.0, 0.0, 0.5}, {}}, tight(bdf, 1e-15));
  Deviation moved, lost;
  int impacts = 0;
  for (const auto& event : r.events) {
    if (event.after.mode.contact != Flank::none) continue;
    ++impacts;
    moved.add(momentum(mesh, event.after) / momentum(mesh, r.rows.front().now) - 1.0);
    lost.add(kinetic(mesh, event.after) / kinetic(mesh, r.rows.front().now) - 1.0);
  }
  INFO(impacts << " impacts, momentum " << moved << ", energy " << lost);
  REQUIRE(impacts >= 1000);
  REQUIRE(moved <= 1e-9);
  REQUIRE(lost <= 1e-9);
}

TEST_CASE("an impact with damping that grows with the penetration loses what its closed form says") {
  // m v dv = -k d (1 + c v) dd: c v - ln(1 + c v) is the same before and after the contact
  const GearMesh<double> mesh(frictionless());
  for (const double c : {0.1, 1.0, 10.0, 100.0}) {
    const auto r = run(thrown(frictionless(), HuntCrossley<double>{k, c}, 1e-3), Timetable(0, 0.0035, 1.0),
                       {0.0, {0.0, 0.0, 0.0, 0.5}, {}});
    REQUIRE(r.events.size() == 2);
    const auto &in = r.events[0].after, &out = r.events[1].after;
    const auto speed = [&](const auto& now) { return mesh.gear_arm(0.0) * (now.x[3] - now.x[1] / mesh.i); };
    const double before = c * speed(in), behind = c * speed(out);
    REQUIRE((before > 0.0 && behind < 0.0 && behind > -before));
    REQUIRE(close(behind - std::log1p(behind), before - std::log1p(before), 1e-9));
    REQUIRE(close(momentum(mesh, out), momentum(mesh, in), 1e-11));
    REQUIRE(kinetic(mesh, out) < kinetic(mesh, in));
  }
}

TEST_CASE("a limited damper loses energy in every impact") {
  const GearMesh<double> mesh(frictionless());
  for (const double D : {1.0, 10.0, 100.0, 1000.0}) {
    const auto r = run(thrown(frictionless(), LimitedDamper<double>{k, D}, 1e-3), Timetable(0, 0.0035, 1.0),
                       {0.0, {0.0, 0.0, 0.0, 0.5}, {}});
    REQUIRE(r.events.size() == 2);
    REQUIRE(kinetic(mesh, r.events[1].after) < kinetic(mesh, r.events[0].after));
    REQUIRE(close(momentum(mesh, r.events[1].after), momentum(mesh, r.events[0].after), 1e-11));
  }
}

TEST_CASE("a contact opens where the force is zero, still deformed, and closes once the teeth have been apart") {
  const auto d = thrown(frictionless(), LimitedDamper<double>{k, 1000.0}, 1e-3);
  const auto r = run(d, Timetable(0, 1.0, 1e-5), {0.0, {0.0, 0.0, 0.0, 0.5}, {}});
  REQUIRE(r.events.size() >= 3);
  const double depth = d.penetration(d.moment(r.events[1].after), Flank::left).first;
  REQUIRE(r.events[1].after.mode.contact == Flank::none);
  REQUIRE(depth > 1e-8);
  REQUIRE(r.events[2].after.mode.contact == Flank::right);
  REQUIRE(d.settle(r.events[1].after).contact == Flank::none);  // a sample there does not close it again
  for (const auto& row : r.rows) REQUIRE(row.seen.normal_force >= -1e-9);
}

TEST_CASE(
    "a tooth that leaves too fast to be pushed is free, and touches again where it is driven back before it parted") {
  const auto p = frictionless();
  const double depth = 1e-7, arm = GearMesh<double>(p).gear_arm(0.0), D = 1000.0, c = 100.0;
  const std::pair<ContactLaw<double>, double> cases[] = {{LimitedDamper<double>{k, D}, k * depth / D},
                                                         {HuntCrossley<double>{k, c}, 1.0 / c}};
  for (const auto& [law, fastest_push] : cases) {
    auto d = compliant(p, constant(0.5), constant(0.0), {law, 1e-3});
    const double deflection = 0.5e-3 + depth / arm, leaving = -1.01 * fastest_push / arm;
    const auto r = run(d, Timetable(0, 1e-4, 1e-6), {0.0, {0.0, 0.0, deflection, leaving}, {}});
    REQUIRE(r.rows.front().now.mode.contact == Flank::none);
    REQUIRE_FALSE(r.events.empty());
    REQUIRE(r.events[0].after.mode.contact == Flank::left);
    REQUIRE(d.penetration(d.moment(r.events[0].after), Flank::left).first > 0.0);
    for (const auto& row : r.rows) REQUIRE(row.seen.normal_force >= -1e-9);
  }
}

TEST_CASE("without a gap the teeth pass from one flank to the other at once") {
  const auto r = run(thrown(frictionless(), HuntCrossley<double>{k, 0.1}, 0.0), Timetable(0, 0.01, 1.0),
                     {0.0, {0.0, 0.0, 0.0, 0.5}, {}});
  REQUIRE(r.events.size() >= 4);
  for (std::size_t n = 0; n < r.events.size(); ++n)
    REQUIRE(r.events[n].after.mode.contact == (n % 2 == 0 ? Flank::right : Flank::left));
}

TEST_CASE("frequency, mass and restitution of a contact are those of the impacts of a run") {
  const GearMesh<double> mesh(frictionless());
  const double mass = effective_mass(mesh, mesh.Jg), approach = 0.02;  // [m/s]
  const double omega_g = approach / mesh.gear_arm(0.0);
  REQUIRE(
      close(contact_frequency({HuntCrossley<double>{k, 0.0}, 0.0}, mass), std::sqrt(squared_frequency(mesh)), 1e-14));
  REQUIRE(restitution({HuntCrossley<double>{k, 0.0}, 0.0}, mass, approach) == 1.0);
  for (const ContactLaw<double>& law :
       {ContactLaw<double>(HuntCrossley<double>{k, 30.0}), ContactLaw<double>(LimitedDamper<double>{k, 100.0})}) {
    const auto r = run(thrown(frictionless(), law, 1e-3), Timetable(0, 0.01, 1.0), {0.0, {0.0, 0.0, 0.0, omega_g}, {}});
    REQUIRE(r.events.size() >= 2);
    const auto& out = r.events[1].after;
    const double parting = -(out.x[3] - out.x[1] / mesh.i) / omega_g;
    REQUIRE(parting < 0.9);
    REQUIRE(std::abs(restitution({law, 0.0}, mass, approach) - parting) <= 1e-8);
  }
}

}  // namespace wormdrive::test::core_compliant_contact
