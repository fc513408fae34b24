#pragma once
// Recordings of the ground truth as loggers write them: at times that are not even, and not every row arrives.
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <fmt/format.h>

#include "diagnosis/sheet.hpp"
#include "recovery/truth/excitation.hpp"

namespace wormdrive::test {

/// A drive under its controller, whose torque changes at the logger's samples only: what is written is what was held.
struct Logger {
  double period = 1e-3;    ///< [s]
  double jitter = 0.0;     ///< most that a sample is early or late [periods]
  double duration = 6.0;   ///< [s]
  std::uint64_t seed = 1;  ///< of motion, noise and jitter

  Sheet write(truth::Drive drive) const {
    constexpr double tick = 1e-5;  // to which a sample may be put [s]
    constexpr long pilot_ticks = 100;
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> early_or_late(-jitter, jitter);
    std::vector<long> at;
    for (double t = 0.0; t < duration - period; t += period)
      at.push_back(std::lround((t + (at.empty() ? 0.0 : early_or_late(random)) * period) / tick));
    // noise of the torque that is new at every tick, and as strong as what the truth holds over a millisecond
    drive.noise.white *= std::sqrt(static_cast<double>(pilot_ticks));
    const auto law = [&at, pilot = truth::follow(truth::rich_course(seed, duration), truth::Sheet{}),
                      asked = 0.0, held = 0.0, sample = std::size_t{0}](double t, double seen) mutable {
      const long now = std::lround(t / tick);
      if (now % pilot_ticks == 0) asked = pilot(t, seen);
      if (sample < at.size() && now == at[sample]) {
        held = asked;
        ++sample;
      }
      return held;
    };
    const truth::Recording all =
        truth::record(drive, law, {.duration = duration, .period = tick, .step = tick, .seed = seed});
    Sheet sheet{{"time_s", "motor_torque_Nm", "gear_angle_rad"}, {}};
    for (const long k : at) {
      const auto row = static_cast<std::size_t>(k);
      sheet.rows.push_back({fmt::format("{:.5f}", all.time[row]), fmt::format("{:.9g}", all.motor_torque[row]),
                            fmt::format("{:.9g}", all.gear_angle[row])});
    }
    return sheet;
  }
};

/// Loses a share of the rows, one by one or in runs.
inline void lose(Sheet& sheet, double share, std::size_t run, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  std::bernoulli_distribution begins(share / static_cast<double>(run));
  std::vector<std::vector<std::string>> left;
  std::size_t lost = 0;
  for (std::size_t k = 0; k < sheet.rows.size(); ++k) {
    if (lost == 0 && k > 0 && begins(random)) lost = run;
    if (lost > 0 && k + 1 < sheet.rows.size())
      --lost;
    else
      left.push_back(std::move(sheet.rows[k]));
  }
  sheet.rows = std::move(left);
}

}  // namespace wormdrive::test
