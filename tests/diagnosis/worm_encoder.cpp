#include <cmath>

#include "catch.hpp"
#include "diagnosis/candidates/magnitudes.hpp"
#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/fitting/gap_search.hpp"
#include "diagnosis/fitting/screening.hpp"
#include "diagnosis/verdict/verdict.hpp"
#include "numbers.hpp"
#include "recovery/campaign.hpp"

// What a second encoder, on the worm, adds to a diagnosis. The data are the recovery tests' own.

namespace wormdrive::test::diagnosis_worm_encoder {

namespace {

struct Bench {
  recovery::Bench recorded;
  Scenario sheet;
  std::vector<Candidate> all;
  Evaluation evaluation;
};

/// A short recording with something hidden, and all that a fit needs.
Bench bench(const char* effect, double amount, double zero = 0.0) {
  recovery::Conditions conditions = recovery::conditions("ideal");
  conditions.worm_counts = 4096;
  recovery::Case drawn{recovery::Kind::single, conditions, 7, {}, 6.0};
  drawn.hidden.push_back({&truth::secret(effect), truth::Size::large, amount});
  recovery::Bench recorded = recovery::record(drawn);
  for (double& angle : recorded.recording.worm_angle) angle += zero;
  const Scenario sheet = recovery::data_sheet(conditions);
  std::vector<PreparedRecording> prepared_one{prepared(recorded.recording, 0, truth::Geometry{}.ratio)};
  const Magnitudes sizes = magnitudes(sheet, prepared_one);
  return {std::move(recorded),
          sheet,
          candidates(sheet.effects, sizes, {}),
          {sheet, InnovationLayout(std::move(prepared_one)), 1}};
}

/// The candidate of that name, fitted alone, from the start that promises most.
Hypothesis fitted(const Bench& b, std::string_view effect) {
  Hypothesis nothing;
  nothing.noise = {0.3, 0.01};
  evaluate(b.evaluation, nothing);
  std::vector<Candidate> one;
  for (const Candidate& candidate : b.all)
    if (candidate.effect == effect) one.push_back(candidate);
  REQUIRE(one.size() == 1);
  Hypothesis h = screen(b.evaluation, nothing, one).found.front().model;
  fit(b.evaluation, h, 10);
  adjust_noise(b.evaluation, h, 6);
  find_gap(b.evaluation, h);
  restart_noise(b.evaluation, h);
  adjust_noise(b.evaluation, h, 3);
  refine_gap(b.evaluation, h);
  fit(b.evaluation, h, 10);
  return h;
}

double field(const Hypothesis& h, std::string_view effect, std::string_view name) {
  return field_of(extended(h), effect, name).value;
}

}  // namespace

TEST_CASE("an encoder on the worm is a second series of innovations with noise of its own") {
  const Bench b = bench("tooth_compliance", 1.5e-3);
  const InnovationLayout& layout = b.evaluation.layout();
  REQUIRE(layout.samples == 6000);
  REQUIRE(layout.size == 12000);
  CHECK(layout.groups() == 4);
  CHECK(layout.leading(0).of_worm);
  CHECK(layout.leading(0).begin == 6000);
  CHECK(layout.group[5999] / 2 == 0);
  CHECK(layout.group[6000] / 2 == 1);
  CHECK(layout.block[6000] == layout.block[0]);
}

TEST_CASE("where the zero of the worm's encoder is does not matter") {
  const Bench here = bench("tooth_compliance", 1.5e-3), there = bench("tooth_compliance", 1.5e-3, 123.4);
  const auto a = here.evaluation.innovations({}, {0.3, 0.0}), b = there.evaluation.innovations({}, {0.3, 0.0});
  REQUIRE(a);
  REQUIRE(b);
  test::Deviation worst;
  for (std::size_t k = 0; k < a->size(); ++k) worst.add((*a)[k] - (*b)[k]);
  CHECK(worst <= 1e-9);
}

TEST_CASE("teeth that yield, an uneven pitch and backlash are found by both encoders together", "[slow]") {
  const Bench yields = bench("tooth_compliance", 1.5e-3);
  const double stiffness = yields.recorded.drive.teeth.stiffness;
  CHECK(std::abs(field(fitted(yields, "tooth_compliance"), "tooth_compliance", "stiffness") / stiffness - 1.0) < 0.05);
  const Bench uneven = bench("transmission_error", 6e-4);
  CHECK(std::abs(field(fitted(uneven, "transmission_error"), "transmission_error", "amplitude") / 6e-4 - 1.0) < 0.05);
  double squares = 0.0;
  const auto gaps = {1e-3, 1.6e-3, 2.5e-3, 4e-3};
  for (const double gap : gaps) {
    const double off = field(fitted(bench("backlash", gap), "backlash"), "backlash", "gap") / gap - 1.0;
    INFO("gap " << gap << ", off by " << off);
    CHECK(std::abs(off) < 0.1);
    squares += off * off;
  }
  // how an impact goes on is known to 5 % of the gap, a standard deviation
  CHECK(std::sqrt(squares / static_cast<double>(gaps.size())) < 0.05);
}

TEST_CASE("torque that is left takes no name back from what both encoders show together") {
  std::vector<Candidate> all(2);
  all[0].effect = "backlash";
  all[1].effect = "worm_viscous";
  for (Candidate& candidate : all) candidate.coordinates.resize(1);
  Selection selection;
  selection.causes = {{0, {}}, {1, {}}};
  Diagnosis one;
  one.causes = {{"backlash", {}}, {"worm_viscous", {}}};
  one.remainders = {{"speed", 9.0, 1e-3, 40.0}};
  Diagnosis two = one;
  judge(one, selection, all, Magnitudes{.torque = 0.05});
  CHECK(one.verdict == Verdict::unexplained);
  CHECK(one.causes.empty());
  judge(two, selection, all, Magnitudes{.torque = 0.05, .has_worm_encoder = true});
  CHECK(two.verdict == Verdict::named);
  REQUIRE(two.causes.size() == 1);
  CHECK(two.causes[0].effect == "backlash");
  CHECK(two.remarks.at(0) == "best of the catalogue, but it leaves structure behind: worm viscous");
}

TEST_CASE("a cause that does most of the work keeps its name beside structure that is left") {
  std::vector<Candidate> all(1);
  all[0].coordinates.resize(1);
  all[0].effect = "worm_viscous";
  const auto judged = [&](double evidence, double error_after) {
    Selection selection;
    selection.causes = {{0, {}}};
    selection.base.bic = evidence;
    selection.model.bic = 0.0;
    Diagnosis d;
    d.causes = {{"worm_viscous", {}}};
    d.remainders = {{"speed", 9.0, 1e-3, 40.0}};
    d.prediction = {{.horizon = 0.25, .before = 1e-2, .after = error_after, .floor = 1e-3}};
    judge(d, selection, all, Magnitudes{.torque = 0.05});
    return d.verdict;
  };
  CHECK(judged(2300.0, 9e-3) == Verdict::unexplained);  // 1150 nats to 40 that are left
  CHECK(judged(2500.0, 9e-3) == Verdict::named);
  CHECK(judged(100.0, 4e-3) == Verdict::unexplained);
  CHECK(judged(100.0, 3e-3) == Verdict::unexplained);  // to a third, but three times the noise
  CHECK(judged(100.0, 1.9e-3) == Verdict::named);
}

}  // namespace wormdrive::test::diagnosis_worm_encoder
