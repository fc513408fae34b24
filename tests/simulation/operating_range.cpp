#include "simulation/operating_range.hpp"

#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "support.hpp"

// Maps of a drive reach as far as its own run does, whatever the size of the drive.

namespace wormdrive::test::simulation_operating_range {
namespace {

/// Table 1 under a sinusoidal motor torque, all torques and inertias of it that many times as large.
Scenario sized(double size) {
  MeshParameters<double> mesh = table1();
  mesh.Jw *= size;
  mesh.Jg *= size;
  Scenario s;
  s.mesh = mesh;
  s.motor = {{Sinusoid{.amplitude = 0.05 * size, .frequency = 1.5, .phase = 90 * unit::degree}}};
  s.load = constant(0.02 * size);
  s.run.duration = 2.0;
  return s;
}

}  // namespace

TEST_CASE("the range of a drive grows with its torques, and its speeds stay as they are") {
  const OperatingRange one = operating_range(sized(1.0));
  CHECK(one.load_torque == 1.5 * 0.02);
  CHECK(one.worm_speed > 60.0);
  for (const double size : {1e-6, 1e-3, 1e3, 1e6}) {
    const OperatingRange range = operating_range(sized(size));
    CAPTURE(size);
    CHECK(std::abs(range.load_torque / size - one.load_torque) < 1e-12 * one.load_torque);
    CHECK(std::abs(range.worm_speed - one.worm_speed) < 1e-6 * one.worm_speed);
  }
}

TEST_CASE("a drive without a run shows a turn of its gear within a second, and its arm") {
  Scenario s = sized(1.0);
  s.run.duration = 0.0;
  s.load = Signal{};
  CHECK(operating_range(s).worm_speed == 60.0 * 2.0 * std::numbers::pi);
  CHECK(operating_range(s).load_torque == 1.0);
  GravityArm arm;
  arm.amplitude = 40.0;
  s.load = arm;
  CHECK(operating_range(s).load_torque == 60.0);
}

TEST_CASE("without a load a drive shows what its motor would hold without losses") {
  Scenario s = sized(1.0);
  s.load = Signal{};
  CHECK(std::abs(operating_range(s).load_torque - 60.0 * 0.05) < 1e-3);
}

}  // namespace wormdrive::test::simulation_operating_range
