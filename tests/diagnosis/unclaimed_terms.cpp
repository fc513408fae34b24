#include <algorithm>
#include <string>

#include "catch.hpp"
#include "diagnosis/answers.hpp"
#include "diagnosis/servo_logs.hpp"

// Effects that come close to what no effect explains: they claim nothing, and predict motions that nobody has seen.

namespace wormdrive::test::diagnosis_unclaimed_terms {

TEST_CASE("a servo whose friction grows with its load is predicted by friction between teeth, which claims no cause",
          "[reference][slow]") {
  Scenario sheet = geared_pendulum();
  std::get<std::optional<GearViscous<double>>>(sheet.effects.list) = {servo_kt * servo_kt / servo_ohm};
  std::vector<Recording> at_worm, at_output;
  for (const std::string& name : servo_logs("kp400")) {
    const auto log = servo_recording(name, sheet);
    if (!log) return;
    at_worm.push_back(*log);
    at_output.push_back(*servo_recording(name, published_servo()));
  }
  const Diagnosis d = diagnose(sheet, at_worm, {.threads = 2});
  CAPTURE(d.sentence);
  CHECK(d.verdict == Verdict::unexplained);
  CHECK(d.causes.empty());
  CHECK(d.sentence.find(
            " The extended scenario holds mesh friction, which claims no cause. On data not used for the fit the "
            "0.25 s prediction error falls from ") != std::string::npos);
  CHECK(std::any_of(d.remarks.begin(), d.remarks.end(), [](const std::string& remark) {
    return remark.starts_with("a line at ") && remark.ends_with(
                                                   " Hz is left, but with it the error 0.25 s ahead falls "
                                                   "by less than 5 %, or no more than by chance");
  }));
  const auto& friction = std::get<std::optional<MeshFriction<double>>>(d.extended.effects.list);
  REQUIRE(friction);
  CHECK(friction->change > 0.01);
  // 98 against 130 mrad
  const Diagnosis of_published = diagnose(published_servo(), at_output, {.threads = 2, .most_causes = 0});
  CHECK(error_ahead(d).after < 0.8 * error_ahead(of_published).before);
}

}  // namespace wormdrive::test::diagnosis_unclaimed_terms
