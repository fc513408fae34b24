#include <cmath>
#include <map>
#include <string>

#include "catch.hpp"
#include "diagnosis/diagnose.hpp"
#include "recovery/forecast.hpp"
#include "recovery/tables.hpp"

// A small part of `risk_campaign`: benches whose data sheets are off, diagnosed, and given a task that is not in the
// data.

namespace wormdrive::test::recovery_forecasts {

TEST_CASE("the drives that data leave possible hold the true one in a task that is not in the data",
          "[recovery][slow]") {
  const recovery::Plan plan{.kind = recovery::Kind::nothing,
                            .conditions = recovery::conditions("realistic"),
                            .cases = 6,
                            .seed = 5,
                            .duration = 10.0,
                            .period = 2e-3};
  std::map<std::string, long> held;
  for (const recovery::Case& drawn : recovery::draw(plan)) {
    const recovery::Bench bench = recovery::record(drawn);
    const Diagnosis found = diagnose(recovery::data_sheet(drawn), {bench.recording}, {.threads = 2});
    const std::vector<recovery::Forecast> list = recovery::forecast(drawn, bench.drive, found, 200);
    REQUIRE(list.size() == 4);
    for (const recovery::Forecast& f : list) {
      held[f.metric] += f.holds();
      CHECK(f.high - f.low > 0.0);
      CHECK(f.high - f.low < 0.2 * std::abs(f.truth));  // a band that holds everything would say nothing
    }
  }
  for (const auto& [metric, count] : held) {
    CAPTURE(metric, count);
    CHECK(count >= recovery::least_successes(plan.cases, 0.9));
  }
}

}  // namespace wormdrive::test::recovery_forecasts
