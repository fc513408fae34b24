#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "catch.hpp"
#include "diagnosis/answers.hpp"
#include "diagnosis/servo_logs.hpp"

// Friction that grows with the load of a drive without teeth: named where a program of a few lines hid it, and kept as
// a term that predicts where a real servo has more than that.

namespace wormdrive::test::diagnosis_friction_under_load {

namespace {

/// A pendulum on a geared motor, by fixed steps: what is stated of it, and what is not.
struct Bench {
  double inertia, weight, dry, viscous;  ///< [kg m^2], [N m], [N m], [N m s/rad]
  double share = 0.0;                    ///< friction per torque of the load

  Scenario sheet() const {
    Scenario s;
    s.mesh = SingleInertia<double>{inertia};
    GravityArm arm;
    arm.amplitude = weight;
    arm.offset = 0.5 * std::numbers::pi;
    s.load = arm;
    std::get<std::optional<WormCoulomb<double>>>(s.effects.list) = {dry};
    std::get<std::optional<WormViscous<double>>>(s.effects.list) = {viscous};
    return s;
  }

  Recording record(std::uint64_t seed, double period) const {
    std::mt19937_64 random(seed);
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> phase(0.0, 2.0 * std::numbers::pi);
    const double swing = std::sqrt(weight / inertia);  // [rad/s]
    const double phases[] = {phase(random), phase(random), phase(random)};
    constexpr int parts = 100;
    const double h = period / parts;
    double angle = 0.0, speed = 0.0;
    Sheet rows{{"time_s", "motor_torque_Nm", "gear_angle_rad"}, {}};
    for (int k = 0; k * period < 10.0; ++k) {
      const double t = k * period;
      double goal = 0.0;
      for (int n = 0; n < 3; ++n) goal += 0.5 * std::sin((0.12 + 0.17 * n) * swing * t + phases[n]);
      const double torque = weight * (4.0 * (goal - angle) - 1.2 * speed / swing);
      rows.rows.push_back({fmt::format("{:.9g}", t), fmt::format("{:.9g}", torque),
                           fmt::format("{:.9g}", angle + 1e-4 * normal(random))});
      const double disturbed = torque + 2e-3 * weight * normal(random);
      for (int part = 0; part < parts; ++part) {
        const double load = -weight * std::sin(angle);
        const double free = speed + h * (disturbed + load - viscous * speed) / inertia;
        const double lost = h * (dry + share * std::abs(load)) / inertia;
        speed = std::copysign(std::max(0.0, std::abs(free) - lost), free);
        angle += h * speed;
      }
    }
    return read(Folder(), rows, sheet());
  }
};

/// Sizes over three decades, each swinging at its own pace.
std::vector<Bench> benches(std::uint64_t seed, int count) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> share(0.1, 0.5), part(0.01, 0.05), decade(-1.5, 1.5), pace(4.0, 12.0);
  std::vector<Bench> all;
  for (int k = 0; k < count; ++k) {
    Bench b{};
    b.weight = std::pow(10.0, decade(random));
    const double swing = pace(random);
    b.inertia = b.weight / (swing * swing);
    b.dry = part(random) * b.weight;
    b.viscous = part(random) * b.weight / swing;
    b.share = share(random);
    all.push_back(b);
  }
  return all;
}

}  // namespace

TEST_CASE("friction that grows with the load is named with its share, and is not named where there is none", "[slow]") {
  std::uint64_t seed = 5;
  for (Bench b : benches(11, 3)) {
    const Diagnosis d = diagnose(b.sheet(), {b.record(++seed, 2e-3)}, {.threads = 2});
    CAPTURE(b.weight, b.inertia, b.share, d.sentence);
    REQUIRE(d.verdict == Verdict::named);
    REQUIRE(d.causes.size() == 1);
    REQUIRE(d.causes[0].effect == "friction_under_load");
    const auto& found = d.causes[0].parameters[0];
    CHECK(std::abs(found.value - b.share) <= 4.0 * found.standard_error);
    CHECK(found.standard_error < 0.1 * b.share);
    b.share = 0.0;
    const Diagnosis clean = diagnose(b.sheet(), {b.record(++seed, 2e-3)}, {.threads = 2});
    CAPTURE(clean.sentence);
    CHECK(clean.verdict == Verdict::adequate);
  }
}

TEST_CASE("friction that grows with the load predicts a servo better than its published model, either way",
          "[reference][slow]") {
  const Scenario sheet = pendulum_with_back_emf(), published = published_servo();
  const std::string gains[] = {"kp100", "kp400"};
  for (int k = 0; k < 2; ++k) {
    std::vector<Recording> seen, unseen;
    for (const std::string& name : servo_logs(gains[k])) {
      const auto log = servo_recording(name, sheet);
      if (!log) return;
      seen.push_back(*log);
    }
    for (const std::string& name : servo_logs(gains[1 - k])) unseen.push_back(*servo_recording(name, sheet));
    const Diagnosis d = diagnose(sheet, seen, {.threads = 2});
    CAPTURE(gains[k], d.sentence);
    if (k == 0) {
      CHECK(d.verdict == Verdict::unexplained);
      CHECK(d.sentence.find(" The extended scenario holds friction under load") != std::string::npos);
      CHECK(d.sentence.find(" no cause.") != std::string::npos);
    } else {
      CHECK(d.verdict == Verdict::named);
      REQUIRE(d.causes.size() == 1);
      CHECK(d.causes[0].effect == "friction_under_load");
    }
    const auto& friction = std::get<std::optional<FrictionUnderLoad<double>>>(d.extended.effects.list);
    REQUIRE(friction);
    CHECK(friction->share > 0.3);
    CHECK(friction->share < 0.6);
    const auto error_of = [&](const Scenario& model) {
      return error_ahead(diagnose(model, unseen, {.threads = 2, .most_causes = 0})).before;
    };
    const double ours = error_of(d.extended), theirs = error_of(published);
    CAPTURE(ours, theirs);
    // 0.89 and 0.943; 0.93 where interpolated rows had halved the encoder's step in two logs, and nothing was named
    CHECK(ours < (k == 0 ? 0.9 : 0.95) * theirs);
  }
}

}  // namespace wormdrive::test::diagnosis_friction_under_load
