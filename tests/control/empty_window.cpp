// Metrics of a window in which no sample falls.
#include <cmath>

#include "catch.hpp"
#include "control/metrics.hpp"

namespace wormdrive::test::control_empty_window {

TEST_CASE("a window without a sample has no metric at all, each by its name", "[control]") {
  MetricsMeter meter({.from = 1.0, .to = 2.0}, 0.3);
  meter.instant(0.0, {});
  meter.instant(1.5, {});
  ControlRecord before{};
  before.measured.t = 0.5;
  meter.sample(before);
  const Metrics found = meter.result();
  for_each_field<Metrics>([&](const auto& field) {
    INFO(field.name);
    CHECK(std::isnan(found.*field.member));
  });
}

}  // namespace wormdrive::test::control_empty_window
