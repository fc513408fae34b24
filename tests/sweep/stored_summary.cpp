// What a complete sweep file holds of its summary is what its trials come to.
#include <csignal>

#include <nlohmann/json.hpp>

#include "catch.hpp"
#include "sweep/studies.hpp"
#include "sweep/summary/summary_json.hpp"

namespace wormdrive::test::sweep_stored_summary {

namespace {

std::string in_full(const SweepReader& sweep, const SweepSummary& summary) {
  return summary_json(sweep, summary, false).dump();
}

}  // namespace

TEST_CASE("a summary that is read is the one that the trials come to, digit for digit", "[sweep]") {
  const std::string few = study_but("trials = 200", "trials = 3");
  for (const std::string& study :
       {good_study, few, lanes_study, study_but("monte_carlo", "latin_hypercube"), study_but("monte_carlo", "sobol")}) {
    const StudyFolder folder(study);
    INFO(study);
    REQUIRE(folder.sweep({"-o", "s.h5"}).exit == 0);
    const SweepReader sweep((folder.path() / "s.h5").string());
    for (const unsigned worst : {0u, 2u, 10u}) {
      const SummarySettings settings{.worst = worst};
      const auto stored = stored_summary(sweep, settings);
      REQUIRE(stored.has_value());
      CHECK(in_full(sweep, *stored) == in_full(sweep, summarise(sweep, settings)));
    }
  }
}

TEST_CASE("what a sweep file does not hold of its summary is worked out", "[sweep]") {
  const StudyFolder folder(lanes_study);
  REQUIRE(folder.sweep({"-o", "s.h5"}).exit == 0);
  const SweepReader sweep((folder.path() / "s.h5").string());
  const std::string ranked_by = default_ranking(sweep.study());
  std::string other;
  for (const Metric& metric : sweep.study().metrics)
    if (metric.name != ranked_by) other = metric.name;
  CHECK(stored_summary(sweep, {.ranked_by = ranked_by}).has_value());
  for (const SummarySettings& settings :
       {SummarySettings{.ranked_by = other}, SummarySettings{.worst = 11}, SummarySettings{.done_only = true}}) {
    CHECK_FALSE(stored_summary(sweep, settings).has_value());
    CHECK(in_full(sweep, summary_of(sweep, settings)) == in_full(sweep, summarise(sweep, settings)));
  }
}

TEST_CASE("neither a part of a sweep nor a design with indices of its own is told from what is stored", "[sweep]") {
  const StudyFolder folder(study_but("design = \"monte_carlo\"\ntrials = 200", "design = \"saltelli\"\nsamples = 16"));
  REQUIRE(folder.sweep({"-o", "s.h5"}).exit == 0);
  CHECK_FALSE(stored_summary(SweepReader((folder.path() / "s.h5").string()), {}).has_value());

  const StudyFolder halved(study_but("trials = 200", "trials = 500000"));
  REQUIRE(halved.interrupted({"-o", "s.h5"}, SIGINT).exit == 128 + SIGINT);
  CHECK_FALSE(stored_summary(SweepReader((halved.path() / "s.h5.part").string()), {}).has_value());
}

}  // namespace wormdrive::test::sweep_stored_summary
