#include <cmath>
#include <string>

#include "catch.hpp"
#include "support.hpp"

// Accelerations of three worm drives, computed by the functions that Mablekos-Alexiou, da Cruz and Bergeles published
// with "Friction-Inclusive Modeling of Sliding Contact Transmission Systems in Robotics", IEEE T-RO 37(4), 2021.

namespace wormdrive::test::reference_worm_oracle {

namespace {

/// A row's drive. In all of them i = 1/(r tan lambda), which is a geometry that closes.
MeshParameters<double> mesh_of(const Table& table, std::size_t row) {
  const double lambda = table.number("lam", row), r = table.number("r", row);
  return {.i = 1.0 / (r * std::tan(lambda)),
          .lambda = lambda,
          .phi_n = table.number("phi", row),
          .lw = r,
          .lg = 1.0,
          .mu = table.number("mu", row),
          .Jw = table.number("Jw", row),
          .Jg = table.number("Jg", row)};
}

Effects<double> supports_of(const Table& table, std::size_t row) {
  return effects(WormCoulomb<double>{table.number("inC", row)}, WormViscous<double>{table.number("inV", row)},
                 GearCoulomb<double>{table.number("outC", row)}, GearViscous<double>{table.number("outV", row)});
}

}  // namespace

TEST_CASE("all 945 published accelerations of three worm drives agree, moving and at rest", "[reference]") {
  const auto table = reference("worm_oracle/forward_dynamics.csv");
  if (!table) return;
  REQUIRE(table->size() == 945);
  int stuck = 0, at_rest = 0, differ = 0, not_stuck = 0;
  Deviation of_allowed;  // deviation over the tolerance that the data's precision allows
  for (std::size_t row = 0; row < table->size(); ++row) {
    const MeshParameters<double> p = mesh_of(*table, row);
    const double tau_m = table->number("tau_m", row), tau_l = table->number("tau_l", row);
    const double published = table->number("acc_worm", row);
    const auto d = entered(p, constant(tau_l), constant(tau_m), supports_of(*table, row));
    typename decltype(d)::Instant now{0.0, {0.0, table->number("w_worm", row) / p.i}, {}};
    now.mode = d.settle(now);
    const double found = p.i * d.observe(now).alpha_g;

    const bool rests = now.x[1] == 0.0;
    if (rests) ++at_rest;
    if (rests && published == 0.0) {
      ++stuck;
      if (now.mode != Mode{} || found != 0.0) ++not_stuck;
    }
    const double torque_size = std::abs(tau_m) + std::abs(tau_l) * p.lw * std::tan(p.lambda);
    const double allowed = 1e-9 * std::abs(published) + 1e-9 * torque_size / p.Jw;
    of_allowed.add((found - published) / allowed);
    if (!(std::abs(found - published) <= allowed)) ++differ;
  }
  REQUIRE(at_rest == 189);
  REQUIRE(stuck == 20);
  REQUIRE(not_stuck == 0);
  REQUIRE(differ == 0);
  REQUIRE(of_allowed <= 1.0);
}

}  // namespace wormdrive::test::reference_worm_oracle
