#pragma once
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <vector>

#include "diagnosis/data/recording.hpp"
#include "diagnosis/data/torque_spikes.hpp"

namespace wormdrive {

/// A recording with what a fit needs to know of every sample beforehand; it follows from the data alone.
struct PreparedRecording {
  Recording data;
  std::vector<double> worm_angle;      ///< counted at the gear, from where the gear is [rad]; empty without an encoder
  double worm_resolution{};            ///< likewise
  std::vector<double> speed;           ///< of the gear, from a line through the samples around [rad/s]
  std::vector<std::uint8_t> moving;    ///< 0: standing
  std::vector<std::uint8_t> used;      ///< 0: left out, or in the burn-in
  std::vector<std::uint8_t> held_out;  ///< not used for fits
  std::vector<TorqueSpike> torque_spikes;
  std::size_t block_length{};  ///< samples
  std::vector<double> shares;  ///< what every reading of the gear's encoder counts; empty: each one wholly
  double rms_speed{};          ///< [rad/s]
  double rms_torque{};         ///< [N m]
  double largest_torque{};     ///< magnitude [N m]

  std::size_t samples() const { return data.samples(); }
  double share(std::size_t k) const { return shares.empty() ? 1.0 : shares[k]; }
  std::size_t blocks() const { return (samples() + block_length - 1) / block_length; }
  /// Of the stretch without a pause in which a sample lies, its first sample, and the sample after its last.
  std::size_t start_of_stretch(std::size_t k) const {
    const auto next = std::upper_bound(data.restarts.begin(), data.restarts.end(), k);
    return next == data.restarts.begin() ? 0 : *std::prev(next);
  }
  std::size_t end_of_stretch(std::size_t k) const {
    const auto next = std::upper_bound(data.restarts.begin(), data.restarts.end(), k);
    return next == data.restarts.end() ? samples() : *next;
  }
  double duration() const { return static_cast<double>(samples()) * data.period; }
};

/// Whether a block is held out, counted through all recordings.
bool is_held_out(std::size_t block);

/// first_block: number of the recording's first block, counted through all recordings. ratio: worm angle over gear
/// angle.
PreparedRecording prepared(Recording recording, std::size_t first_block, double ratio = 1.0);

/// The same with nothing held out: for the final fit.
PreparedRecording with_all_data(PreparedRecording recording);

}  // namespace wormdrive
