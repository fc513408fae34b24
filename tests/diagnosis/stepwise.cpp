#include "diagnosis/fitting/stepwise.hpp"

#include <cmath>

#include "catch.hpp"
#include "diagnosis/candidates/tolerances.hpp"
#include "diagnosis/fitting/fit.hpp"
#include "diagnosis/inference/intervals.hpp"
#include "diagnosis/recordings.hpp"
#include "support.hpp"

// Friction at rest shows at break-aways alone: a fit has to search it, for there is no slope to follow.

namespace wormdrive::test::diagnosis_stepwise {

TEST_CASE("friction at rest is found from starts on either side, within its interval") {
  constexpr double rise = 0.08;
  Scenario drive = nominal_arm();
  set_field(drive.effects, {"static_friction", "rise", rise});
  const PreparedRecording recording = with_all_data(prepared(record(drive, {.duration = 12.0, .period = 1e-3}), {}, 0));
  const Magnitudes sizes = magnitudes(nominal_arm(), {recording});
  const auto all = candidates({}, sizes, toleranced_coordinates(nominal_arm(), sizes, {}));
  const Evaluation evaluation(nominal_arm(), InnovationLayout({recording}), 2);
  std::size_t index = 0;
  while (all[index].effect != "static_friction") ++index;
  REQUIRE_FALSE(has_slope(all[index].coordinates[0]));
  for (const std::size_t start : {1U, 3U}) {
    Hypothesis h;
    add_candidate(h, all, index, start);
    CAPTURE(h.values[0]);
    fit(evaluation, h, 3);
    adjust_noise(evaluation, h, 6);
    fit(evaluation, h, 3);
    const double error = std::sqrt(covariance(evaluation, h, 0)(0, 0));
    CAPTURE(h.values[0], error);
    CHECK(std::abs(h.values[0] - rise) < 1.96 * error);
    CHECK(error < 0.3 * rise);
  }
}

}  // namespace wormdrive::test::diagnosis_stepwise
