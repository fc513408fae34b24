#include "diagnosis/candidates/stated_parts.hpp"

#include <cmath>
#include <functional>
#include <vector>

#include "catch.hpp"
#include "diagnosis/answers.hpp"
#include "diagnosis/recordings.hpp"

// Drives whose effects have states, or whose inertia depends on the angle: sound where nothing is hidden, and where a
// number of such a part is another one, or something else is, that is named.

namespace wormdrive::test::diagnosis_stated_parts {

namespace {

template <class Effect>
Scenario arm_with(const Effect& effect) {
  Scenario s = nominal_arm();
  s.tolerance = Tolerances{};
  std::get<std::optional<Effect>>(s.effects.list) = effect;
  return s;
}

DcMotor<double> winding() {
  DcMotor<double> motor{1.2, 0.03};
  motor.inductance = 3e-3;
  return motor;
}

Diagnosis diagnosed(const Scenario& stated, const Scenario& truth) {
  RecordingConditions conditions;
  conditions.duration = 4.0;
  conditions.period = 4e-3;
  return diagnose(stated, {record(truth, conditions)});
}

/// Hides another number in a part that is stated, and asks that it is found, and that the model predicts as well then
/// as noise lets it.
template <class Effect>
void check_found(const Effect& stated, double Effect::*number, double hidden, std::string_view field) {
  Effect truth = stated;
  truth.*number = hidden;
  const Diagnosis d = diagnosed(arm_with(stated), arm_with(truth));
  INFO(d.sentence);
  REQUIRE(d.causes.size() == 1);
  REQUIRE(names(d, Effect::id));
  const Estimate& found = cause(d, Effect::id)->parameters.front();
  CHECK(found.field == field);
  CHECK(std::abs(found.value - hidden) <= 4.0 * found.standard_error);
  CHECK(std::abs(found.value - hidden) <= 0.2 * std::abs(hidden - stated.*number));
  CHECK(error_ahead(d).after <= 0.5 * error_ahead(d).before);
}

}  // namespace

TEST_CASE("a drive with a winding, warming oil, bristles or a crank is sound where nothing is hidden", "[.][long]") {
  for (const Scenario& s : {arm_with(winding()), arm_with(GearboxHeat<double>{0.02, 0.0, 0.0, 0.2, 10.0}),
                            arm_with(MeshLuGre<double>{2000.0, 2.0}), arm_with(LoadCrank<double>{0.5, 0.04, 0.1})}) {
    const Diagnosis d = diagnosed(s, s);
    INFO(d.sentence);
    CHECK(d.causes.empty());
    CHECK(d.verdict == Verdict::adequate);
  }
}

TEST_CASE("friction of the bearings is named beside a winding", "[slow]") {
  Scenario truth = arm_with(winding());
  std::get<std::optional<WormCoulomb<double>>>(truth.effects.list) = {0.002};
  const Diagnosis d = diagnosed(arm_with(winding()), truth);
  INFO(d.sentence);
  REQUIRE(d.causes.size() == 1);
  REQUIRE(names(d, "worm_coulomb"));
  CHECK(std::abs(cause(d, "worm_coulomb")->parameters.front().value - 0.002) <= 2e-4);
}

TEST_CASE("a motor's torque constant is named where it is another one than stated", "[slow]") {
  check_found(winding(), &DcMotor<double>::torque_constant, 0.034, "torque_constant");
}

TEST_CASE("so are numbers of bristles, of warming oil and of a crank", "[.][long]") {
  check_found(MeshLuGre<double>{2000.0, 2.0}, &MeshLuGre<double>::stiffness, 500.0, "stiffness");
  check_found(GearboxHeat<double>{0.02, 0.0, 0.0, 0.2, 10.0}, &GearboxHeat<double>::friction_decay, 0.04,
              "friction_decay");
  check_found(LoadCrank<double>{0.5, 0.04, 0.1}, &LoadCrank<double>::mass, 0.8, "mass");
}

TEST_CASE("a part that is stated is a candidate with its numbers, one that is not has a reason") {
  Effects<double> on;
  std::get<std::optional<DcMotor<double>>>(on.list) = winding();
  const auto numbers = [&] {
    std::vector<std::string_view> fields;
    for (const Coordinate& c : stated_parts(on).at(0).coordinates) fields.push_back(c.field);
    return fields;
  };
  using Fields = std::vector<std::string_view>;
  REQUIRE(stated_parts(on).size() == 1);
  CHECK(numbers() == Fields{"torque_constant"});  // what asks for a torque gets it, whatever the winding
  DcMotor<double>& motor = *std::get<std::optional<DcMotor<double>>>(on.list);
  motor.amplifier_gain = 40.0;
  CHECK(numbers() == Fields{"torque_constant", "resistance"});
  motor.amplifier_gain.reset();
  motor.current_bandwidth = 200.0;
  CHECK(numbers() == Fields{"current_bandwidth"});
  const std::size_t all = parts_not_examined({}).size();
  CHECK(parts_not_examined(on).size() == all - 1);
  for (const NotExamined& part : parts_not_examined({})) CHECK_FALSE(part.reason.empty());
}

}  // namespace wormdrive::test::diagnosis_stated_parts
