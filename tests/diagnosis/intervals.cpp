#include "diagnosis/inference/intervals.hpp"

#include <cmath>
#include <string_view>

#include "catch.hpp"
#include "diagnosis/candidates/tolerances.hpp"
#include "diagnosis/recordings.hpp"

// What an interval holds beside the noise: what the predictor itself gets wrong.

namespace wormdrive::test::diagnosis_intervals {

namespace {

/// A hypothesis with everything that is stated and one candidate, from its last start.
Hypothesis extended_by(std::string_view effect) {
  const Scenario drive = nominal_arm();
  const PreparedRecording recording = prepared(record(drive, {.duration = 2.0}), {}, 0);
  const Magnitudes sizes = magnitudes(drive, {recording});
  const auto stated = toleranced_coordinates(drive, sizes, {});
  const auto all = candidates({}, sizes, stated);
  Hypothesis h;
  for (const Coordinate& c : stated) {
    h.free.push_back(c);
    h.values.push_back(c.centre);
  }
  for (std::size_t k = 0; k < all.size(); ++k)
    if (all[k].effect == effect) add_candidate(h, all, k, all[k].starts.size() - 1);
  return h;
}

/// Standard error of a free coordinate by data without noise.
double error(const Hypothesis& h, std::string_view effect, std::string_view field) {
  const auto n = static_cast<Eigen::Index>(h.free.size());
  for (const Coordinate& c : h.free)
    if (c.effect == effect && c.field == field)
      return estimated(h, Eigen::MatrixXd::Zero(n, n), effect, {c}).parameters.front().standard_error;
  return std::nan("");
}

}  // namespace

TEST_CASE("beside a gap a stated parameter is known no better than its tolerance") {
  const Hypothesis gap = extended_by("backlash"), none = extended_by("worm_viscous");
  for (const Coordinate& c : gap.free) {
    if (c.tolerance <= 0.0) continue;
    CAPTURE(c.effect);
    CHECK(std::abs(error(gap, c.effect, c.field) / c.tolerance - 1.0) < 1e-6);
    CHECK(error(none, c.effect, c.field) < 0.5 * c.tolerance);
  }
  const double size = gap.values.back();
  CHECK(std::abs(error(gap, "backlash", "gap") / std::hypot(0.05 * size, 2e-5) - 1.0) < 1e-6);
}

TEST_CASE("the friction at rest from where it falls is as uncertain as the fall") {
  const Hypothesis h = extended_by("stribeck");
  const double drop = h.values[h.values.size() - 2];  // before the speed of the fall
  CHECK(std::abs(error(h, "stribeck", "drop") / (0.1 * drop) - 1.0) < 1e-6);
  CHECK(std::abs(error(h, "mesh_friction", "change") / (0.1 * drop) - 1.0) < 1e-6);
}

}  // namespace wormdrive::test::diagnosis_intervals
