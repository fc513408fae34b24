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

}  // namespace wormdrive::test::diagnosis_verdict
