#include <algorithm>

#include "catch.hpp"
#include "description/toml/parse_scenario.hpp"
#include "description/toml/write_scenario.hpp"
#include "diagnosis/candidates/coordinates.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/recordings.hpp"
#include "support.hpp"

// A slow motion over a small angle leaves a class; a second payload, or the experiment that the diagnosis proposes,
// splits it.

namespace wormdrive::test::diagnosis_several_recordings {

namespace {

/// The arm, weighed exactly, with another payload than 1 kg perhaps.
Scenario exact_arm(double mass = 1.0) {
  Scenario arm = nominal_arm();
  arm.tolerance = Tolerances{.friction = 0.0,
                             .load = 0.0,
                             .load_angle = 0.0,
                             .worm_inertia = 0.0,
                             .gear_inertia = 0.0,
                             .torque_gain = 0.0,
                             .torque_offset = 0.0};
  std::get<GravityArm>(arm.load).mass = mass;
  return arm;
}

Scenario with(Scenario drive, const FieldValue& planted) {
  set_field(drive.effects, planted);
  return drive;
}

/// A sweep at 0.1 Hz, with the load that it moved.
Recording slow_sweep(const Scenario& drive, double amplitude, std::uint64_t seed) {
  Recording r = record(
      drive, {.duration = 12.0, .seed = seed, .motion = {SinusoidReference{.amplitude = amplitude, .frequency = 0.1}}});
  r.load = drive.load;
  return r;
}

std::vector<std::string> ids(const Diagnosis& d) {
  std::vector<std::string> all;
  for (const EstimatedEffect& cause : d.causes) all.push_back(cause.effect);
  return all;
}

bool holds(const std::vector<std::string>& list, const std::string& id) {
  return std::find(list.begin(), list.end(), id) != list.end();
}

}  // namespace

TEST_CASE("a second payload, or the proposed experiment, splits the class that one recording leaves", "[slow]") {
  const FieldValue planted{"worm_coulomb", "torque", 5e-4};
  const Recording light = slow_sweep(with(exact_arm(), planted), 0.1, 1);
  const Recording heavy = slow_sweep(with(exact_arm(2.0), planted), 0.1, 2);
  const Diagnosis one = diagnose(exact_arm(), {light}), other = diagnose(exact_arm(), {heavy});
  CAPTURE(one.sentence, other.sentence);
  for (const Diagnosis* d : {&one, &other}) {
    CHECK(d->verdict == Verdict::ambiguous);
    CHECK(holds(d->classes.at(0), "worm_coulomb"));
    CHECK(holds(d->classes.at(0), "mesh_friction"));
  }
  const auto splits_the_class = [](const Diagnosis& d) {
    CAPTURE(d.sentence);
    CHECK(d.verdict == Verdict::named);
    CHECK(ids(d) == std::vector<std::string>{"worm_coulomb"});
    CHECK(d.classes.empty());
  };
  splits_the_class(diagnose(exact_arm(), {light, heavy}));

  REQUIRE(one.experiment);
  CHECK_NOTHROW(parse_scenario(to_toml(*one.experiment), "experiment", {}, Purpose::run));
  Scenario made = *one.experiment;  // on the true drive, not on the one that was found
  made.effects = {};
  set_field(made.effects, planted);
  made.control->disturbance.deviation = 5e-4;
  Recording second = simulated(made);
  second.load = made.load;
  splits_the_class(diagnose(exact_arm(), {light, second}));
}

}  // namespace wormdrive::test::diagnosis_several_recordings
