#include <cmath>

#include "catch.hpp"
#include "cli/program.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/run_scenario.hpp"
#include "support.hpp"

// Figure 10 of the paper in its readings: docs/figure10.md has the table.

namespace wormdrive::test::control_figure10 {

namespace {

Metrics metrics(const std::string& file, const std::vector<std::string>& changes = {}) {
  return run_scenario(load_scenario(shipped(file), changes, Purpose::run)).control->metrics;
}
const std::vector<std::string> sine{"load.torque_Nm=0.0176", "load.angle_offset_deg=-90"};

/// Whether a value lies between two others, widened by 15 percent.
bool within(double value, double low, double high) { return value >= 0.85 * low && value <= 1.15 * high; }

}  // namespace

TEST_CASE("fig. 10: the sliding error of the bare gear is that of finding 10 within 15 percent") {
  for (const auto& load : {std::vector<std::string>{}, sine}) {
    const Metrics radians = metrics("fig10_sliding_014rad_bare.toml", load);
    REQUIRE(within(radians.error_peak_to_peak, 1.0e-4, 1.1e-4));
    REQUIRE(within(radians.torque_peak, 0.043, 0.046));
  }
  const Metrics degrees = metrics("fig10_sliding_014deg_bare.toml");
  REQUIRE(within(degrees.error_peak_to_peak, 9.4e-5, 9.4e-5));
  REQUIRE(within(degrees.torque_peak, 0.011, 0.011));
}

TEST_CASE("fig. 10: with the load's inertia the sliding controller errs by 2 mrad, also with ideal samples") {
  REQUIRE(within(metrics("fig10_sliding_014rad_loaded.toml").error_peak_to_peak, 1.9e-3, 1.9e-3));
  REQUIRE(within(metrics("fig10_sliding_014rad_loaded.toml", {"controller.sample_time_s=1e-4", "sensor.speed=exact",
                                                              "sensor.speed_filter_Hz=0", "run.duration_s=2"})
                     .error_peak_to_peak,
                 1.8e-3, 1.8e-3));
}

TEST_CASE("fig. 10: the sliding error is 26 percent of the PID's at p = 100 rad/s") {
  const double sliding = metrics("fig10_sliding_014rad_bare.toml").error_peak_to_peak;
  const double pid = metrics("fig10_pid_014rad_bare.toml").error_peak_to_peak;
  REQUIRE(close(sliding / pid, 0.26, 0.05));
}

}  // namespace wormdrive::test::control_figure10
