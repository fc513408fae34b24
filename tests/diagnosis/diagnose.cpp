#include "diagnosis/diagnose.hpp"

#include <algorithm>
#include <stdexcept>

#include "catch.hpp"
#include "description/toml/write_scenario.hpp"
#include "diagnosis/candidates/catalogue.hpp"
#include "diagnosis/candidates/tolerances.hpp"
#include "diagnosis/diagnosis_settings.hpp"
#include "diagnosis/recordings.hpp"
#include "some_of.hpp"
#include "support.hpp"

// Whole diagnoses of recordings of the program's own drive; what a foreign drive hides is the recovery tests' business.

namespace wormdrive::test::diagnosis_diagnose {

namespace {

constexpr double half_length = 12.0;  // [s]: enough for what is planted here

Diagnosis of(const std::vector<FieldValue>& planted, int threads = 2, double period = RecordingConditions{}.period) {
  Scenario drive = nominal_arm();
  for (const FieldValue& f : planted) set_field(drive.effects, f);
  DiagnosisSettings settings;
  settings.threads = threads;
  return diagnose(nominal_arm(), {record(drive, {.duration = half_length, .period = period})}, settings);
}

double value_of(const Diagnosis& d, std::string_view field) {
  for (const Estimate& p : d.causes.at(0).parameters)
    if (p.field == field) return p.value;
  throw std::out_of_range("no such parameter");
}

const Visibility& visibility(const Diagnosis& d, std::string_view effect) {
  return *std::find_if(d.certificate.begin(), d.certificate.end(), [&](const auto& v) { return v.effect == effect; });
}

}  // namespace

TEST_CASE("a recording of the drive as stated is adequate, and the certificate knows what it could have shown",
          "[slow]") {
  const Diagnosis d = of({}, 2, 1e-3);
  REQUIRE(d.verdict == Verdict::adequate);
  REQUIRE(d.causes.empty());
  REQUIRE(d.remainders.empty());
  REQUIRE(d.sentence == "The simulation contains every effect that these data show.");
  for (const PredictionError& e : d.prediction) {
    CAPTURE(e.horizon, e.after, e.floor);
    const double spread = e.horizon > 0.5 ? 1.7 : 1.3;  // 12 s have few stretches of 1 s
    CHECK(e.floor > e.after / spread);
    CHECK(e.floor < e.after * spread);
  }
  for (const RankedCandidate& c : d.ranking)  // what was only screened has no standard error, and no zero in its place
    for (const Estimate& p : c.effect.parameters) CHECK(p.standard_error != 0.0);
  CHECK(visibility(d, "actuator_delay").nearest == "encoder_delay");
  CHECK(visibility(d, "encoder_delay").likeness == 1.0);
  // half a sample of 1 ms late is as good as a lag, three are not
  for (const char* late : {"actuator_delay", "actuator_lag", "encoder_delay"}) {
    CAPTURE(late);
    CHECK(visibility(d, late).detectable < 0.5e-3);
    CHECK(visibility(d, late).nameable > 0.5e-3);
    CHECK(visibility(d, late).nameable < 6e-3);
  }
  CHECK(visibility(d, "load_angle").nearest == "encoder_offset");
  CHECK(visibility(d, "backlash").detectable < 1e-3);
  CHECK_FALSE(visibility(d, "tooth_compliance").observable);
  CHECK(visibility(d, "worm_coulomb").detectable < 1e-3);
  CHECK(visibility(d, "worm_coulomb").detectable <= visibility(d, "worm_coulomb").nameable);
  // a stated parameter is a cause only beyond its tolerance, 1 % of 0.25
  CHECK(visibility(d, "mesh_friction").detectable >= 3.5 * 0.0025);
}

TEST_CASE("what is planted is named, with its size within the interval, and predicts data that were held out",
          "[slow][cases]") {
  struct Planted {
    std::vector<FieldValue> values;
    double share;  // of the size that the estimate may be off
  };
  for (const auto& [values, share] : some_of(std::vector{Planted{{{"mesh_friction", "change", 0.03}}, 0.1},
                                                         Planted{{{"worm_viscous", "coefficient", 4e-5}}, 0.05},
                                                         Planted{{{"torque_offset", "torque", 1.5e-2}}, 0.05}})) {
    const Diagnosis d = of(values);
    CAPTURE(values[0].effect, d.sentence);
    REQUIRE(d.verdict == Verdict::named);
    REQUIRE(d.causes.size() == 1);
    REQUIRE(d.causes[0].effect == values[0].effect);
    CHECK(close(value_of(d, values[0].field), values[0].value, share));
    CHECK(d.ranking.front().named);
    CHECK(d.prediction.at(1).after < 0.7 * d.prediction.at(1).before);
    CHECK(close(field_of(d.extended.effects, values[0].effect, values[0].field).value, values[0].value, share));
  }
}

TEST_CASE("names that are withdrawn leave nothing in the extended scenario", "[slow]") {
  Recording backward = record(nominal_arm(), {.duration = 5.0});
  std::reverse(backward.motor_torque.begin(), backward.motor_torque.end());
  const Diagnosis d = diagnose(nominal_arm(), {backward});
  REQUIRE(d.verdict == Verdict::unexplained);
  REQUIRE(d.causes.empty());
  CAPTURE(d.sentence);
  REQUIRE(d.sentence.find("Noise of ") != std::string::npos);
  REQUIRE(to_toml(d.extended) == to_toml(nominal_arm()));
}

TEST_CASE("a delay is named together with its twin", "[slow]") {
  const Diagnosis d = of({{"actuator_delay", "delay", 3e-3}});
  REQUIRE(d.verdict == Verdict::ambiguous);
  REQUIRE(d.classes == std::vector<std::vector<std::string>>{{"actuator_delay", "encoder_delay"}});
  CHECK(close(value_of(d, "delay"), 3e-3, 0.02));
  CHECK_FALSE(d.experiment);
}

TEST_CASE("a diagnosis does not depend on the number of threads", "[slow]") {
  Scenario drive = nominal_arm();
  set_field(drive.effects, {"worm_coulomb", "torque", 4e-3});
  const std::vector<Recording> seen{record(drive, {.duration = 4.0})};
  const Diagnosis one = diagnose(nominal_arm(), seen, {.threads = 1}),
                  three = diagnose(nominal_arm(), seen, {.threads = 3});
  REQUIRE(one.causes.at(0).effect == "worm_coulomb");
  REQUIRE(value_of(one, "torque") == value_of(three, "torque"));
  REQUIRE(one.passes == three.passes);
  REQUIRE(one.ranking.size() == three.ranking.size());
  for (std::size_t k = 0; k < one.ranking.size(); ++k) {
    REQUIRE(one.ranking[k].effect.effect == three.ranking[k].effect.effect);
    REQUIRE(one.ranking[k].delta_bic == three.ranking[k].delta_bic);
  }
}

TEST_CASE("every effect of the catalogue is a candidate, a candidate's twin, or says why it is not examined") {
  const Scenario arm = nominal_arm();
  const Magnitudes sizes = magnitudes(arm, {prepared(record(arm, {.duration = 3}), {}, 0)});
  const auto all = candidates({}, sizes, toleranced_coordinates(arm, sizes, {}));
  const auto others = not_examined({}, sizes);
  Effects<double>{}.for_each([&]<class E>(const std::optional<E>&) {
    CAPTURE(E::id);
    const bool is_candidate = std::any_of(all.begin(), all.end(), [](const Candidate& s) {
      return s.effect == E::id ||
             std::any_of(s.twins.begin(), s.twins.end(), [](const Twin& t) { return t.effect == E::id; });
    });
    const bool has_reason =
        std::any_of(others.begin(), others.end(), [](const NotExamined& n) { return n.effect == E::id; });
    REQUIRE(is_candidate != has_reason);
  });
}

TEST_CASE(
    "what a load comes to in a recording follows from angle, speed and time, and whether it turns from its terms") {
  const PreparedRecording r = prepared(record(nominal_arm(), {.duration = 3}), {}, 0);
  double fastest = 0.0;
  for (std::size_t k = 0; k < r.samples(); k += 50) fastest = std::max(fastest, std::abs(r.speed[k]));
  const Fan fan{.rated_torque = 0.3, .rated_speed = 2.0};
  GravityArm arm;
  arm.amplitude = 0.5;
  const auto of = [&](std::vector<LoadTerm> terms) {
    Scenario drive = nominal_arm();
    drive.load = load_of(std::move(terms));
    return magnitudes(drive, {r});
  };
  CHECK(close(of({fan}).load_torque, 0.3 * fastest * fastest / 4.0, 1e-12));
  CHECK_FALSE(of({fan}).load_turns);
  CHECK_FALSE(of({fan, Constant{0.1}}).load_turns);
  CHECK(of({Step{.torque = 0.7, .time = 1.0}}).load_torque == 0.7);
  CHECK(of({arm, fan}).load_turns);
  CHECK(of({arm, fan}).load_torque > of({arm}).load_torque);
  const auto others = not_examined({}, of({fan}));
  CHECK(std::any_of(others.begin(), others.end(), [](const NotExamined& n) { return n.effect == "load_angle"; }));
}

TEST_CASE("a drive that no diagnosis predicts is refused with the effect that is to blame") {
  Scenario coupled = nominal_arm();
  std::get<std::optional<LoadCoupling<double>>>(coupled.effects.list) = LoadCoupling<double>{1e-3, 20.0};
  REQUIRE_THROWS_WITH(diagnose(coupled, {}),
                      "a diagnosis follows no load that swings by itself, which nothing that is recorded shows, but "
                      "effect.load_coupling twists; leave its stiffness out");
}

TEST_CASE("recordings that cannot be diagnosed are refused") {
  REQUIRE_THROWS_WITH(diagnose(nominal_arm(), {}), "a diagnosis needs a recording");
  Recording still;
  still.period = 1e-3;
  still.motor_torque.assign(3000, 0.01);
  still.gear_angle.assign(3000, 0.1);
  REQUIRE_THROWS_WITH(diagnose(nominal_arm(), {still}), "nothing moves in the recording");
  still.motor_torque.resize(300);
  still.gear_angle.resize(300);
  REQUIRE_THROWS_WITH(diagnose(nominal_arm(), {still}),
                      "a diagnosis needs recordings of at least 3 s and 1000 samples");
}

}  // namespace wormdrive::test::diagnosis_diagnose
