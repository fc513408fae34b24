#pragma once
// Recordings of the ground truth as loggers write them: at times that are not even, and not every row arrives.
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <fmt/format.h>

#include "diagnosis/sheet.hpp"
#include "recovery/lost_rows.hpp"
#include "recovery/truth/excitation.hpp"

namespace wormdrive::test {

/// A drive under its controller, whose torque changes at the logger's samples only: what is written is what was held.
struct Logger {
  double period = 1e-3;    ///< [s]
  double jitter = 0.0;     ///< most that a sample is early or late [periods]
  double duration = 6.0;   ///< [s]
  std::uint64_t seed = 1;  ///< of motion, noise and jitter

  Sheet write(const truth::Drive& drive) const {
    const auto course = truth::rich_course(seed, duration, period);
    const truth::Recording r = truth::record(drive, truth::follow(course, truth::Sheet{}),
                                             {.duration = duration, .period = period, .jitter = jitter, .seed = seed});
    Sheet sheet{{"time_s", "motor_torque_Nm", "gear_angle_rad"}, {}};
    for (std::size_t k = 0; k < r.time.size(); ++k)
      sheet.rows.push_back({fmt::format("{:.5f}", r.time[k]), fmt::format("{:.9g}", r.motor_torque[k]),
                            fmt::format("{:.9g}", r.gear_angle[k])});
    return sheet;
  }
};

/// Loses a share of the rows, one by one or in runs.
inline void lose(Sheet& sheet, double share, std::size_t run, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  recovery::lose(sheet.rows, recovery::lost_rows(sheet.rows.size(), share, run, random));
}

}  // namespace wormdrive::test
