#include <numbers>

#include <fmt/format.h>

#include "catch.hpp"
#include "description/diagnostics.hpp"
#include "diagnosis/sheet.hpp"

// A speed that is recorded beside the angle, in logs of any rate: it is its derivative, or the log is rejected.

namespace wormdrive::test::diagnosis_recorded_speeds {
namespace {

/// Forty seconds of a sine of 2.5 Hz at 1 kHz.
const truth::Recording& sine() {
  static const truth::Recording recording = [] {
    truth::Drive drive;
    drive.sensor.counts = 16384;
    constexpr double duration = 40.0;
    return truth::record(drive, truth::follow(truth::slow_course(0.3, 2.5, duration), truth::Sheet{}),
                         {.duration = duration, .seed = 9});
  }();
  return recording;
}

/// Every so many-th sample of it, with so many times its speed.
Sheet logged(std::size_t every, double factor) {
  const truth::Recording& r = sine();
  Sheet sheet{{"time_s", "motor_torque_Nm", "gear_angle_rad", "gear_speed_rad_per_s"}, {}};
  for (std::size_t k = 0; k < r.time.size(); k += every)
    sheet.rows.push_back({fmt::format("{:.6g}", r.time[k]), fmt::format("{:.9g}", r.motor_torque[k]),
                          fmt::format("{:.9g}", r.gear_angle[k]), fmt::format("{:.9g}", factor * r.true_speed[k])});
  return sheet;
}

const std::string nothing;

std::string said_of(const Sheet& sheet) {
  const Folder folder;
  try {
    read(folder, sheet);
    return nothing;
  } catch (const InputFault& fault) {
    return fault.what();
  }
}

}  // namespace

TEST_CASE("a recorded speed is compared with the angle alike at every rate of the log", "[slow]") {
  for (const std::size_t every : {1, 2, 5, 10, 16, 20}) {
    CAPTURE(every);
    CHECK(said_of(logged(every, 1.0)) == nothing);
    CHECK(said_of(logged(every, 0.5)).find("is not the derivative of gear_angle_rad: 0.") != std::string::npos);
    CHECK(said_of(logged(every, -1.0)).find("is not the derivative of gear_angle_rad: -") != std::string::npos);
    CHECK(said_of(logged(every, 30.0 / std::numbers::pi)).find("is in rpm") != std::string::npos);
    CHECK(said_of(logged(every, 60.0)).find("is the speed of the worm") != std::string::npos);
  }
}

}  // namespace wormdrive::test::diagnosis_recorded_speeds
