#include "diagnosis/inference/comparison.hpp"

#include "catch.hpp"
#include "diagnosis/recordings.hpp"
#include "numbers.hpp"

// When a candidate is believed, from what speaks for it alone.

namespace wormdrive::test::diagnosis_comparison {

namespace {

Candidate candidate(std::string_view effect, bool toleranced = false) {
  Candidate s;
  s.effect = effect;
  s.coordinates = {{.effect = effect, .field = "", .scale = 1.0, .low = -10.0, .high = 10.0}};
  s.coordinates[0].stepwise = effect == "static_friction";
  s.toleranced = toleranced;
  return s;
}

/// Evidence that suffices for any candidate.
Evidence good() {
  return {.delta_bic = 100.0,
          .held_out = 20.0,
          .without_best = 15.0,
          .clipped = 18.0,
          .positive_share = 0.9,
          .tolerances = 5.0,
          .everywhere_but_best = 60.0};
}

constexpr const char* refuted = "does not predict the data that were held out";

}  // namespace

TEST_CASE("a candidate is believed for evidence that held-out data bear out") {
  Evidence e = good();
  CHECK(outcome(e, candidate("cogging")) == "named");
  e.delta_bic = 19.0;
  CHECK(outcome(e, candidate("cogging")) == "too little evidence");
  e.delta_bic = -1.0;
  CHECK(outcome(e, candidate("cogging")) == "no evidence");
  e = good();
  e.at_bound = true;
  CHECK(outcome(e, candidate("cogging")) == "its parameter stands at a bound");
}

TEST_CASE("a gain that hangs on one held-out block counts if most blocks gain") {
  Evidence e = good();
  e.without_best = -1.0;
  CHECK(outcome(e, candidate("cogging")) == "named");
  e.positive_share = 0.6;
  CHECK(outcome(e, candidate("cogging")) == refuted);
}

TEST_CASE("friction at rest shows at single break-aways, and those that were fitted count") {
  Evidence e = good();
  e.without_best = -1.0;
  e.positive_share = 0.6;
  CHECK(outcome(e, candidate("static_friction")) == "named");
  e.everywhere_but_best = 19.0;
  CHECK(outcome(e, candidate("static_friction")) == refuted);
  e.everywhere_but_best = 60.0;
  e.held_out = 2.0;
  CHECK(outcome(e, candidate("static_friction")) == refuted);
}

TEST_CASE("a stated parameter needs evidence beyond its tolerance, and must not make what was held out worse") {
  Evidence e = good();
  e.delta_bic = 6.0;
  e.held_out = e.without_best = e.clipped = -2.0;
  CHECK(outcome(e, candidate("gear_inertia", true)) == "named");
  e.held_out = -4.0;
  CHECK(outcome(e, candidate("gear_inertia", true)) == refuted);
  e.delta_bic = 100.0;  // of numbers far beyond their tolerances
  CHECK(outcome(e, candidate("gear_inertia", true)) == "named");
  e.held_out = -5.1;
  CHECK(outcome(e, candidate("gear_inertia", true)) == refuted);
  e.tolerances_without = 4.0;  // a tolerance draws it back and leaves it far off all the same
  CHECK(outcome(e, candidate("gear_inertia", true)) == "named");
  e.tolerances_without = 2.0;
  e.tolerances = 3.0;
  CHECK(outcome(e, candidate("gear_inertia", true)) == "within what its tolerance leaves open");
  e.delta_bic = 4.0;
  CHECK(outcome(e, candidate("gear_inertia", true)) == "no evidence beyond the stated tolerance");
}

TEST_CASE("a fault of the recording need not predict more than stated parameters do that are far off without it") {
  Candidate fault = candidate("time_scale");
  fault.of_recording = true;
  Evidence e = good();
  e.held_out = e.without_best = e.clipped = -4.0;
  CHECK(outcome(e, fault) == refuted);
  e.of_tolerances = 51.0;  // of 100
  CHECK(outcome(e, fault) == "named");
  CHECK(outcome(e, candidate("cogging")) == refuted);
  e.held_out = -5.1;
  CHECK(outcome(e, fault) == refuted);
}

TEST_CASE("held-out blocks vote by the ranks of their gains") {
  const InnovationLayout layout({prepared(record(nominal_arm(), {.duration = 12.0}), 0)});
  const std::vector<double> gains{-1.0, 5.0, -2.0, 6.0, 9.0, 7.0, 8.0, -1000.0};  // eight of 24 blocks
  REQUIRE(layout.blocks == 3 * gains.size());
  Hypothesis without, with;
  without.misfit.blocks.assign(layout.blocks, 0.0);
  with.misfit.blocks.assign(layout.blocks, -20.0);
  for (std::size_t k = 0; k < gains.size(); ++k) with.misfit.blocks[3 * k + 2] = -gains[k];
  const Evidence e = compare(without, with, candidate("cogging"), layout);
  CHECK(close(e.held_out, -968.0, 1e-15));
  CHECK(close(e.without_best, -977.0, 1e-15));
  CHECK(close(e.positive_share, (3.0 + 4.0 + 5.0 + 6.0 + 7.0) / 36.0, 1e-15));
  CHECK(close(e.clipped, 32.0 - 4.0 * 7.0, 1e-15));  // the lost block counts four times the median of the sizes
}

TEST_CASE("beside a gap a cause has to gain in most blocks, and not by one of them") {
  Evidence e = good();
  e.beside_gap = true;
  const Candidate s = candidate("gear_viscous"), stated = candidate("gear_inertia", true);
  CHECK(outcome(e, s) == "named");
  Evidence one = e;
  one.without_best = -1.0;
  CHECK(outcome(one, s) == refuted);
  Evidence few = e;
  few.positive_share = 0.6;
  CHECK(outcome(few, s) == refuted);
  // a stated parameter was free before, and has gained most of it there
  Evidence none = e;
  none.held_out = none.without_best = none.clipped = none.positive_share = 0.0;
  CHECK(outcome(none, s) == refuted);
  CHECK(outcome(none, stated) == "named");
  none.held_out = -5.1;
  CHECK(outcome(none, stated) == refuted);
}

}  // namespace wormdrive::test::diagnosis_comparison
