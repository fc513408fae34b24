#include "diagnosis/inference/comparison.hpp"

#include "catch.hpp"

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

TEST_CASE("a stated number needs evidence beyond its tolerance, and must not make what was held out worse") {
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
  e.tolerances = 3.0;
  CHECK(outcome(e, candidate("gear_inertia", true)) == "within what its tolerance leaves open");
  e.delta_bic = 4.0;
  CHECK(outcome(e, candidate("gear_inertia", true)) == "no evidence beyond the stated tolerance");
}

TEST_CASE("beside a gap a cause has to gain in most blocks, and not by one of them") {
  Evidence e = good();
  e.beside_gap = true;
  for (const bool toleranced : {false, true}) {
    const Candidate s = candidate("gear_viscous", toleranced);
    CHECK(outcome(e, s) == "named");
    Evidence one = e;
    one.without_best = -1.0;
    CHECK(outcome(one, s) == refuted);
    Evidence few = e;
    few.positive_share = 0.6;
    CHECK(outcome(few, s) == refuted);
  }
}

}  // namespace wormdrive::test::diagnosis_comparison
