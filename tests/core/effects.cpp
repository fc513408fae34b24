#include "core/effects.hpp"

#include <cmath>
#include <cstring>
#include <numbers>
#include <set>
#include <string>

#include "catch.hpp"
#include "support.hpp"

namespace wormdrive::test::core_effects {

namespace {

const Moment<double> forwards{0.0, 0.4, 2.0, 120.0}, backwards{0.0, 0.4, -2.0, -120.0};

Effects<double> bearings(double torque, double coefficient) {
  return effects(WormCoulomb<double>{torque}, WormViscous<double>{coefficient}, GearCoulomb<double>{torque},
                 GearViscous<double>{coefficient});
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

TEST_CASE("dry friction acts on its own shaft against the motion, at its full size whatever the speed") {
  const Effects<double> worm = effects(WormCoulomb<double>{0.3}), gear = effects(GearCoulomb<double>{0.3});
  REQUIRE(worm.worm_torque(forwards, Motion::forward) == -0.3);
  REQUIRE(worm.worm_torque(backwards, Motion::backward) == 0.3);
  REQUIRE(worm.gear_torque(forwards, Motion::forward) == 0.0);
  REQUIRE(gear.gear_torque(forwards, Motion::forward) == -0.3);
  REQUIRE(gear.gear_torque(backwards, Motion::backward) == 0.3);
  REQUIRE(gear.worm_torque(forwards, Motion::forward) == 0.0);
}

TEST_CASE("dry friction follows the motion's name and not the speed: at rest it is absent, at zero speed it is not") {
  const Effects<double> worm = effects(WormCoulomb<double>{0.3});
  const Moment<double> standing{0.0, 0.0, 0.0, 0.0};
  REQUIRE(worm.worm_torque(standing, Motion::stuck) == 0.0);
  REQUIRE(worm.worm_torque(standing, Motion::forward) == -0.3);
  REQUIRE(worm.worm_torque(standing, Motion::backward) == 0.3);
}

TEST_CASE("viscous friction acts with the speed of its own shaft") {
  const Effects<double> worm = effects(WormViscous<double>{0.01}), gear = effects(GearViscous<double>{0.01});
  REQUIRE(worm.worm_torque(forwards, Motion::forward) == -0.01 * 120.0);
  REQUIRE(worm.worm_torque(backwards, Motion::backward) == 0.01 * 120.0);
  REQUIRE(worm.gear_torque(forwards, Motion::forward) == 0.0);
  REQUIRE(gear.gear_torque(forwards, Motion::forward) == -0.01 * 2.0);
  REQUIRE(gear.worm_torque(forwards, Motion::forward) == 0.0);
}

TEST_CASE("effects add up on each shaft") {
  const Effects<double> all = bearings(0.3, 0.01);
  REQUIRE(all.worm_torque(forwards, Motion::forward) == -0.3 + -0.01 * 120.0);
  REQUIRE(all.gear_torque(backwards, Motion::backward) == 0.3 + 0.01 * 2.0);
}

TEST_CASE(
    "an absent effect leaves every acceleration bit-identical to the bare equation, and so does one of size zero") {
  const MeshParameters<double> p = table1();
  const auto bare = entered(p, fig9_load(), fig9_motor());
  const auto idle = entered(p, fig9_load(), fig9_motor(), bearings(0.0, 0.0));
  for (const Mode& mode : moving_modes)
    for (const double t : {0.01, 0.4, 1.7})
      for (const double theta : {-3.0, 0.1, 2.0}) {
        const auto at = bare.moment(t, theta, sign(mode.motion) * 0.7);
        const double tau_m = 0.05 * portable::cos(2.0 * std::numbers::pi * 1.5 * t + 90 * unit::degree);
        const double tau_l = 0.0196 * portable::cos(theta);
        const double C = bare.mesh().C(mode.product() * p.mu);
        REQUIRE(same_bits(bare.acceleration(at, mode), (tau_m + C * tau_l) / (p.Jw * p.i + C * p.Jg)));
        REQUIRE(same_bits(bare.acceleration(at, mode), idle.acceleration(at, mode)));
      }
}

TEST_CASE("a run with effects of size zero is bit-identical to a run without them") {
  const auto without = run(drive(table1(), fig9_load(), fig9_motor()), Timetable(0, 0.8, 0.01), {});
  const auto idle = run(drive(table1(), fig9_load(), fig9_motor(), bearings(0.0, 0.0)), Timetable(0, 0.8, 0.01), {});
  REQUIRE(without.rows.size() == idle.rows.size());
  for (std::size_t k = 0; k < without.rows.size(); ++k) {
    REQUIRE(same_bits(without.rows[k].now.t, idle.rows[k].now.t));
    REQUIRE(same_bits(without.rows[k].now.x[0], idle.rows[k].now.x[0]));
    REQUIRE(same_bits(without.rows[k].now.x[1], idle.rows[k].now.x[1]));
    REQUIRE(without.rows[k].now.mode == idle.rows[k].now.mode);
  }
}

TEST_CASE("a torque limit that cuts only the top of a wave is left where the wave comes back below it") {
  Piece wave;
  wave.cosines.push_back({.amplitude = 1.0, .omega = 2.0 * std::numbers::pi, .phase = 0.0});
  for (double excess : {1e-3, 1e-5, 1e-7}) {
    const double limit = 1.0 - excess, half = std::acos(limit) / (2.0 * std::numbers::pi);
    const LimitedPiece before = limited(wave, limit, -0.3), top = limited(wave, limit, before.until);
    REQUIRE(std::abs(before.until - -half) <= 1e-9);
    REQUIRE((top.piece.cosines.empty() && top.piece.constant == limit));
    REQUIRE(std::abs(top.until - half) <= 1e-9);
    REQUIRE(limited(wave, limit, top.until).piece.cosines.size() == 1);
  }
}

TEST_CASE("no two effects of the catalogue share an id, and each is named after where it acts") {
  std::set<std::string> ids;
  Effects<double>{}.for_each([&]<class E>(const std::optional<E>&) {
    REQUIRE(ids.insert(std::string(E::id)).second);
    if (E::id.starts_with("worm_")) REQUIRE(E::place == Place::worm_shaft);
    if (E::id.starts_with("gear_")) REQUIRE(E::place == Place::gear_shaft);
    if (E::id.starts_with("load_")) REQUIRE(E::place == Place::load);
    if (E::id.starts_with("encoder_")) REQUIRE(E::place == Place::sensor);
  });
}

}  // namespace wormdrive::test::core_effects
