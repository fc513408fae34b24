#include "diagnosis/verdict/verdict.hpp"

#include "catch.hpp"
#include "diagnosis/fitting/prediction_error.hpp"
#include "diagnosis/rules/noise.hpp"

namespace wormdrive::test::diagnosis_verdict {

namespace {

/// One named effect that changes the error ahead.
Diagnosis named(const char* effect, double before, double after) {
  Diagnosis d;
  d.causes = {{effect, {}}};
  PredictionError e;
  e.horizon = rules::reported_horizon;
  e.before = before;
  e.after = after;
  e.floor = 1e-3;
  d.prediction = {e};
  std::vector<Candidate> all(1);
  all[0].coordinates.resize(1);
  all[0].effect = effect;
  Selection selection;
  selection.base.bic = 0.0;
  selection.model.bic = -624.0;
  selection.causes = {{0, {}}};
  judge(d, selection, all, Magnitudes{.torque = 0.05});
  return d;
}

}  // namespace

TEST_CASE("a name that makes the error ahead no smaller says on what it stands") {
  CHECK(named("cogging", 2e-3, 1e-3).remarks.empty());
  CHECK(
      named("cogging", 1e-3, 2e-3).remarks ==
      std::vector<std::string>{"the error 0.25 s ahead is not smaller: the named causes rest on the likelihood of the "
                               "single samples, 312 nats"});
  CHECK(
      named("backlash", 1e-3, 2e-3).remarks ==
      std::vector<std::string>{"the error 0.25 s ahead is not smaller: the named causes rest on the likelihood of the "
                               "single samples, 312 nats; teeth that bounce cannot be followed far"});
}

TEST_CASE("a model that predicts a motion knows it, however much noise torque it needs") {
  const auto verdict = [](double noise_torque, double error_over_short, double error_over_long) {
    Diagnosis d;
    d.noise_torque = noise_torque;
    d.prediction = {{.horizon = 0.1, .after = error_over_short, .floor = 1.0, .constant_speed = 0.02},
                    {.horizon = 1.0, .after = error_over_long, .floor = 1.0, .constant_speed = 0.5}};
    judge(d, {}, {}, Magnitudes{.torque = 0.05});
    return d.verdict;
  };
  CHECK(verdict(0.06, 0.010, 0.10) == Verdict::unexplained);
  CHECK(verdict(0.06, 0.010, 0.07) == Verdict::adequate);  // 0.14 of a constant speed's
  CHECK(verdict(0.06, 0.002, 0.50) == Verdict::adequate);  // 0.10: what the error grows to is another matter
  CHECK(verdict(0.01, 0.010, 0.10) == Verdict::adequate);  // a slow motion is predicted as well by its speed
}

TEST_CASE("a model that needs much noise torque names no cause, even where it predicts the motion") {
  std::vector<Candidate> all(1);
  all[0].effect = "bearing_asymmetry";
  all[0].coordinates.resize(1);
  Selection selection;
  selection.causes = {{0, {}}};
  Diagnosis d;
  d.causes = {{"bearing_asymmetry", {}}};
  d.noise_torque = 0.7;
  d.prediction = {{.horizon = 0.25, .before = 4e-3, .after = 6e-3, .floor = 5e-3, .constant_speed = 0.2}};
  judge(d, selection, all, Magnitudes{.torque = 0.5});
  CHECK(d.causes.empty());
  CHECK(d.sentence ==
        "The simulation lacks something that no effect of the catalogue explains. Noise of 0.7 N m rms "
        "remains, compared with 0.5 N m of the motor.");
}

}  // namespace wormdrive::test::diagnosis_verdict
