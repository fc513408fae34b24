#include "core/elastic/compliant_energy.hpp"

#include <cmath>

#include "catch.hpp"
#include "compliant_drives.hpp"

// What goes into a drive with elastic teeth is stored or lost. Only a geometry that closes accounts for it.

namespace wormdrive::test::core_compliant_energy {

namespace {

/// Table 1 with the lead angle that its ratio needs.
MeshParameters<double> closed() { return closing(table1()); }

/// Works [J] of a run, by observed forces alone.
struct Works {
  double in = 0.0;       ///< of motor and load
  double lost = 0.0;     ///< in friction, bearings and the damping of the teeth
  double damping = 0.0;  ///< the teeth's share of it
};

template <class Drive>
Works rates(const Drive& d, const typename Drive::Instant& now, double k, double backlash) {
  const Observation seen = d.observe(now);
  const MeshParameters<double> p = closed();
  const double w = seen.teeth->omega_w, g = seen.omega_g, arm = p.lg * std::cos(p.phi_n) * std::cos(p.lambda);
  const double side = seen.teeth->deflection > 0.0 ? 1.0 : -1.0;
  const double d_n = arm * (side * seen.teeth->deflection - backlash / 2), v_n = arm * side * (g - w / p.i);
  const double damping = d_n > 0.0 ? (seen.normal_force - k * d_n) * v_n : 0.0;
  const double sliding = seen.teeth->friction * (p.lw * std::cos(p.lambda) * w + p.lg * std::sin(p.lambda) * g);
  const auto at = d.moment(now);
  const double bearings =
      d.effects().worm_torque(at, now.mode.worm) * w + d.effects().gear_torque(seen.tau_l, at, now.mode.gear) * g;
  const double in = seen.tau_m * w + seen.tau_l * g;
  return {in, damping + sliding - bearings, damping};
}
double stored(const Observation& seen, const MeshParameters<double>& p, double Jg, double k, double backlash) {
  const double arm = p.lg * std::cos(p.phi_n) * std::cos(p.lambda);
  const double d_n = std::max(0.0, arm * (std::abs(seen.teeth->deflection) - backlash / 2));
  return 0.5 * (p.Jw * seen.teeth->omega_w * seen.teeth->omega_w + Jg * seen.omega_g * seen.omega_g + k * d_n * d_n);
}

/// Adds the works between two changes of the mode, integrated along with the state in steps of their own, which end
/// where a formula bends: where a limited damper reaches its limit, and where teeth that have parted are in shape
/// again.
template <class Drive>
void add_works(Works& sum, Drive d, const typename Drive::Instant& now, double end, double k, double backlash) {
  const bool apart = now.mode.contact == Flank::none;
  const int steps = std::max(20, static_cast<int>((end - now.t) / (apart ? 4e-5 : 4e-6)));
  const double h = (end - now.t) / steps;
  d.enter(now.t);
  using Extended = std::array<double, 7>;
  const auto at = [&](double t, const Extended& y) {
    return typename Drive::Instant{t, {y[0], y[1], y[2], y[3]}, now.mode};
  };
  const auto rate = [&](double t, const Extended& y) {
    const auto instant = at(t, y);
    const auto x = d.derivative(t, instant.x, now.mode);
    const Works w = rates(d, instant, k, backlash);
    return Extended{x[0], x[1], x[2], x[3], w.in, w.lost, w.damping};
  };
  const auto beyond_the_bend = [&](const Extended& y) {
    if (apart) return std::abs(y[2] - y[0] / closed().i) > backlash / 2;
    const auto* const law = std::get_if<LimitedDamper<double>>(&d.contact().law);
    if (!law) return false;
    const auto [depth, approach] = d.penetration(d.moment(at(now.t, y)), now.mode.contact);
    return law->damping * approach > law->stiffness * depth;
  };
  Extended y{now.x[0], now.x[1], now.x[2], now.x[3], sum.in, sum.lost, sum.damping};
  for (int n = 0; n < steps; ++n)
    piecewise_step(
        rate, beyond_the_bend, [](double, const Extended&) {}, now.t + n * h, y, h);
  sum = {y[4], y[5], y[6]};
}

}  // namespace

TEST_CASE("through a thousand impacts the work of motor and load is stored, rubbed away and damped, within 1e-9",
          "[slow]") {
  const double k = 1e6, backlash = 1e-3;
  Signal motor = fig9_motor();
  motor.terms.push_back(Sinusoid{.amplitude = 0.3, .frequency = 60.0, .phase = 0.0});
  const Effects<double> bearings = effects(WormCoulomb<double>{2e-3}, GearViscous<double>{1e-3});
  for (const ContactLaw<double>& law :
       {ContactLaw<double>(HuntCrossley<double>{k, 20.0}), ContactLaw<double>(LimitedDamper<double>{k, 50.0})}) {
    const auto d = compliant(closed(), fig9_load(), motor, {law, backlash}, bearings);
    const auto r = run(d, Timetable(0, 6.5, 100.0), {0.0, {0.0, 0.0, 0.0, 0.0}, {}}, tight(bdf, 1e-13));
    Works sum;
    int impacts = 0;
    auto begin = r.rows.front().now;
    const auto close = [&](const auto& end) { add_works(sum, d, begin, end.t, k, backlash); };
    for (const auto& event : r.events) {
      close(event.before);
      begin = event.after;
      impacts += event.before.mode.contact == Flank::none && event.after.mode.contact != Flank::none;
    }
    close(r.end);
    const double Jg = d.rigid().Jg();
    const double gained = stored(d.observe(r.end), closed(), Jg, k, backlash) -
                          stored(d.observe(r.rows.front().now), closed(), Jg, k, backlash);
    const double missing = sum.in - sum.lost - gained;
    INFO(impacts << " impacts; work " << sum.in << " J, lost " << sum.lost << " J, in the teeth " << sum.damping
                 << " J, gained " << gained << " J, missing " << missing << " J");
    REQUIRE(impacts >= 1000);
    REQUIRE(sum.damping > 1e-3 * sum.lost);
    REQUIRE(std::abs(missing) <= 1e-9 * sum.lost);
  }
}

TEST_CASE("power and stored energy of elastic teeth are those of the observed forces") {
  const double k = 1e6, backlash = 1e-3;
  auto d = compliant(closed(), fig9_load(), fig9_motor(), {HuntCrossley<double>{k, 2.0}, backlash},
                     effects(WormCoulomb<double>{2e-3}, GearViscous<double>{1e-3}));
  d.enter(0.1);
  for (const double theta_w : {-0.05, 0.0, 0.05})
    for (const double omega_w : {-3.0, 0.0, 3.0}) {
      typename decltype(d)::Instant now{0.1, {theta_w, omega_w, 0.0, 0.1}, {}};
      now.mode = d.settle(now);
      const Power of = power(d, now);
      const Works expected = rates(d, now, k, backlash);
      REQUIRE(std::abs(of.motor + of.load - expected.in) <= 1e-12);
      REQUIRE(std::abs(of.loss - expected.lost) <= 1e-12);
      REQUIRE(close(stored_energy(d, now), stored(d.observe(now), closed(), d.rigid().Jg(), k, backlash), 1e-12));
    }
}

}  // namespace wormdrive::test::core_compliant_energy
