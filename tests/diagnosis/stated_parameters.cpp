#include <algorithm>
#include <cmath>
#include <string>

#include "catch.hpp"
#include "diagnosis/answers.hpp"
#include "diagnosis/candidates/coordinates.hpp"
#include "diagnosis/diagnose.hpp"
#include "recovery/campaign.hpp"
#include "some_of.hpp"

// What a scenario states and the data deny is said, whatever else is wrong with the drive.

namespace wormdrive::test::diagnosis_stated_parameters {

namespace {

struct Hidden {
  std::string effect;
  double amount;
};

recovery::Case realistic_case(std::uint64_t seed, const std::vector<Hidden>& hidden) {
  recovery::Case drawn{recovery::Kind::stated_off, recovery::conditions("realistic"), seed, {}, 12.0, 2e-3};
  for (const Hidden& h : hidden) drawn.hidden.push_back({&truth::secret(h.effect), truth::Size::medium, h.amount});
  return drawn;
}

Diagnosis diagnosed(const recovery::Case& drawn) {
  return diagnose(recovery::data_sheet(drawn), {recovery::record(drawn).recording}, {.threads = 2});
}

}  // namespace

TEST_CASE("a stated parameter that is far off is named beside another cause", "[slow][cases]") {
  const auto stated = recovery::stated_errors;
  for (const auto& [effect, number] : some_of(
           std::vector{std::pair{Hidden{"worm_viscous", 4e-5}, Hidden{"load_angle", 10.0 * stated.angle}},
                       std::pair{Hidden{"stribeck", 0.04}, Hidden{"torque_offset", -9.0 * stated.offset}},
                       std::pair{Hidden{"friction_asymmetry", 0.02}, Hidden{"load_magnitude", 8.0 * stated.share}}})) {
    const Diagnosis d = diagnosed(realistic_case(41, {effect, number}));
    CAPTURE(d.sentence, effect.effect, number.effect);
    CHECK(d.causes.size() == 2);
    CHECK(names(d, effect.effect));
    CHECK(names(d, number.effect));
  }
}

TEST_CASE("a stated parameter that exact data show far off is named, however little it moves beyond its tolerance",
          "[slow]") {
  const auto stated = recovery::stated_errors;
  const truth::Geometry g;
  for (const Hidden& number : std::vector<Hidden>{{"mesh_friction", 6.0 * stated.share * truth::Sheet{}.friction},
                                                  {"load_magnitude", -6.0 * stated.share},
                                                  {"load_angle", 6.0 * stated.angle},
                                                  {"torque_offset", -6.0 * stated.offset},
                                                  {"worm_inertia", 6.0 * stated.share * g.worm_inertia}}) {
    recovery::Case drawn{recovery::Kind::nothing, recovery::conditions("ideal"), 45, {}, 8.0};
    drawn.hidden.push_back({&truth::secret(number.effect), truth::Size::medium, number.amount});
    const recovery::Bench bench = recovery::record(drawn);
    const Diagnosis d =
        diagnose(recovery::data_sheet(recovery::conditions("realistic")), {bench.recording}, {.threads = 2});
    CAPTURE(d.sentence, number.effect);
    REQUIRE(d.causes.size() == 1);
    CHECK(recovery::same_or_twin(d.causes[0].effect, truth::secret(number.effect)));
    CHECK(std::abs(d.causes[0].parameters[0].value / number.amount - 1.0) < 0.2);
  }
}

TEST_CASE("every class is told, that of a second cause too", "[slow]") {
  const Diagnosis d =
      diagnosed(realistic_case(42, {{"encoder_delay", 3e-3}, {"load_angle", -12.0 * recovery::stated_errors.angle}}));
  CAPTURE(d.sentence, d.experiment_reason);
  CHECK(d.verdict == Verdict::ambiguous);
  auto classes = d.classes;
  std::sort(classes.begin(), classes.end());
  CHECK(classes ==
        std::vector<std::vector<std::string>>{{"actuator_delay", "encoder_delay"}, {"load_angle", "encoder_offset"}});
  for (const char* const word : {"actuator delay from encoder delay", "load angle from encoder offset"})
    CHECK(d.sentence.find(word) != std::string::npos);
  CHECK(d.experiment_reason.find("time stamp") != std::string::npos);
}

TEST_CASE("an effect that is stated and is not there is named", "[slow][cases]") {
  const recovery::Case drawn{recovery::Kind::nothing, recovery::conditions("realistic"), 44, {}, 12.0, 2e-3};
  const Recording recording = recovery::record(drawn).recording;
  for (const FieldValue& stated : some_of(std::vector{FieldValue{"actuator_delay", "delay", 1.5e-3},
                                                      FieldValue{"worm_viscous", "coefficient", 4e-5},
                                                      FieldValue{"gear_coulomb", "torque", 0.06}})) {
    Scenario sheet = recovery::data_sheet(drawn);
    set_field(sheet.effects, stated);
    const Diagnosis d = diagnose(sheet, {recording}, {.threads = 2});
    CAPTURE(d.sentence, stated.effect);
    for (const std::vector<std::string>& of_class : d.classes)  // what acts later was recorded too early, or seen so
      for (const std::string& twin : of_class)
        CHECK((stated.effect == "actuator_delay" &&
               (twin == stated.effect || twin == "encoder_delay" || twin == "torque_late")));
    CHECK(d.verdict == (d.classes.empty() ? Verdict::named : Verdict::ambiguous));
    REQUIRE(d.causes.size() == 1);
    CHECK(d.causes[0].effect == stated.effect);
    CHECK(std::abs(d.causes[0].parameters[0].value) < 0.1 * stated.value);
  }
}

TEST_CASE("values that move within wide tolerances are told and written, with what they gain", "[slow]") {
  recovery::Case drawn{recovery::Kind::nothing, recovery::conditions("ideal"), 43, {}, 12.0, 2e-3};
  const Recording recording = recovery::record(drawn).recording;
  Scenario sheet = recovery::data_sheet(drawn);
  const double friction = std::get<MeshParameters<double>>(sheet.mesh).mu;
  std::get<MeshParameters<double>>(sheet.mesh).mu = 0.8 * friction;
  sheet.tolerance->friction = 0.3;
  const Diagnosis d = diagnose(sheet, {recording}, {.threads = 2});
  CAPTURE(d.sentence);
  CHECK(d.verdict == Verdict::adequate);
  CHECK(d.sentence.find("once stated parameters move within their tolerances: mesh friction: change ") !=
        std::string::npos);
  CHECK(d.sentence.find("prediction error falls") != std::string::npos);
  CHECK(std::abs(field_of(d.extended.effects, "mesh_friction", "change").value / (0.2 * friction) - 1.0) < 0.02);
}

}  // namespace wormdrive::test::diagnosis_stated_parameters
