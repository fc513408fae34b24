#include <cmath>
#include <vector>

#include "catch.hpp"
#include "control/closed_loop.hpp"
#include "support.hpp"

// An encoder that hands its angle on late: every sample sees the angle of the delay before it.

namespace wormdrive::test::control_encoder_delay {

namespace {

struct Nothing {
  ControlSignals operator()(const Measurement&) const { return {}; }
};

/// A wheel that turns as 0.3 + 0.1 t^2.
WormDrive<double, TimedLoad> turning_wheel(const Effects<double>& on) {
  return {GearMesh<double>::without_teeth(2.0), make_load(constant(0.4)), on, {}};
}

/// Angles that samples at 0.05 + 0.1 k s see of it.
std::vector<double> seen(double age, By by) {
  const Effects<double> on = age > 0.0 ? effects(EncoderDelay<double>{age}) : Effects<double>{};
  std::vector<double> angles;
  ClosedLoop loop(Nothing{}, Reference{}, SensorSettings{}, SamplingSettings{.period = 0.1, .offset = 0.05},
                  DisturbanceSettings{}, [&](const ControlRecord& sample) { angles.push_back(sample.measured.angle); });
  run(turning_wheel(on), Timetable(0, 1, 0.03, {0.1, 0.05, on.measuring_delay()}), {0.0, {0.3, 0.0}, {}}, tight(by),
      loop);
  return angles;
}

}  // namespace

TEST_CASE("encoder_delay: a sample sees the angle of the delay before it, and the start's before that") {
  for (const By by : every_solver)
    for (const double age : {0.0, 0.02, 0.05, 0.1, 0.37}) {
      const std::vector<double> angles = seen(age, by);
      REQUIRE(angles.size() == 10);
      for (std::size_t k = 0; k < angles.size(); ++k) {
        const double then = std::max(0.0, 0.05 + 0.1 * static_cast<double>(k) - age);
        INFO("sample " << k << ", delay " << age);
        REQUIRE(std::abs(angles[k] - (0.3 + 0.1 * then * then)) <= 1e-12);
      }
    }
}

TEST_CASE("an exact speed is that of the angle that the sample sees: as late, and scaled as much") {
  for (const double age : {0.0, 0.02, 0.37})
    for (const double share : {0.0, 0.05, -0.2}) {
      Effects<double> on = effects(EncoderScale<double>{share}, EncoderOffset<double>{0.4});
      if (age > 0.0) std::get<std::optional<EncoderDelay<double>>>(on.list) = EncoderDelay<double>{age};
      std::vector<double> speeds;
      ClosedLoop loop(Nothing{}, Reference{}, {.exact_speed = true}, {.period = 0.1, .offset = 0.05},
                      DisturbanceSettings{}, [&](const ControlRecord& r) { speeds.push_back(r.measured.speed); });
      run(turning_wheel(on), Timetable(0, 1, 0.03, {0.1, 0.05, on.measuring_delay()}), {0.0, {0.3, 0.0}, {}}, tight(),
          loop);
      REQUIRE(speeds.size() == 10);
      for (std::size_t k = 0; k < speeds.size(); ++k) {
        const double then = std::max(0.0, 0.05 + 0.1 * static_cast<double>(k) - age);
        INFO("sample " << k << ", delay " << age << ", share " << share);
        REQUIRE(std::abs(speeds[k] - (1.0 + share) * 0.2 * then) <= 1e-12);
      }
    }
}

}  // namespace wormdrive::test::control_encoder_delay
