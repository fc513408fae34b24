#pragma once
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/load.hpp"

namespace wormdrive {

/// A recording of a drive in SI; plain data.
struct Recording {
  std::string name;                  ///< the file's, or what the caller calls it
  double start{};                    ///< time of the first sample [s]
  double period{};                   ///< between two samples, on average [s]
  std::vector<double> times{};       ///< of the samples since the first, where they are not even [s]; else empty
  std::vector<double> motor_torque;  ///< as commanded, held from its sample to the next [N m]
  std::vector<double> gear_angle;    ///< [rad]
  std::vector<double> worm_angle;    ///< [rad]; empty without an encoder on the worm
  std::vector<std::uint8_t> valid;   ///< 0 where a sample is missing, or one that no measurement can have given
  double gear_resolution{};          ///< step of the gear's encoder as seen in the data [rad]; 0: finer than the noise
  double worm_resolution{};          ///< likewise of the worm's [rad]
  std::vector<std::size_t> restarts{};   ///< samples before which so many are missing that nothing is predicted across
  std::optional<LoadParameters> load{};  ///< in place of the scenario's: a second payload
  std::vector<std::string> remarks{};    ///< what was found and mended, one sentence each

  std::size_t samples() const { return gear_angle.size(); }
  /// Of a sample, since the first [s].
  double time(std::size_t k) const { return times.empty() ? static_cast<double>(k) * period : times[k]; }
  bool has_worm_encoder() const { return !worm_angle.empty(); }
};

}  // namespace wormdrive
