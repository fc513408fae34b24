#pragma once
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "diagnosis/data/prepared_recording.hpp"

namespace wormdrive {

/// Innovations of one sensor in one recording.
struct Channel {
  std::size_t recording;
  bool of_worm;       ///< else of the gear
  std::size_t begin;  ///< among all innovations
  double resolution;  ///< of the sensor, counted at the gear [rad]
};

/// Innovations of all recordings one after another, as a fit looks at them: those of the gear's encoders, then those of
/// the worms'.
struct InnovationLayout {
  std::vector<PreparedRecording> recordings;
  std::vector<std::size_t> begins;        ///< of each recording's gear
  std::vector<std::size_t> first_blocks;  ///< number of each recording's first block
  std::vector<Channel> channels;          ///< the first ones are the gears', in the order of the recordings
  std::size_t samples = 0;                ///< of all recordings
  std::size_t size = 0;                   ///< innovations of all
  std::size_t blocks = 0;                 ///< of all
  std::vector<std::uint8_t> group;        ///< of every innovation: 2 channel + moving
  std::vector<std::uint8_t> part;         ///< of every innovation: 0 not used, 1 fitted, 2 held out
  std::vector<std::uint32_t> block;       ///< of every innovation
  std::vector<double> share;              ///< of every innovation: what it counts

  explicit InnovationLayout(std::vector<PreparedRecording> all);

  std::size_t groups() const { return 2 * channels.size(); }
  template <class T>
  std::span<T> of(const Channel& channel, std::span<T> e) const {
    return e.subspan(channel.begin, recordings[channel.recording].samples());
  }
  /// Those of the gear's encoder.
  template <class T>
  std::span<T> of(std::size_t recording, std::span<T> e) const {
    return of(channels[recording], e);
  }
  /// Those of the worm's encoder, none without one.
  template <class T>
  std::span<T> of_worm(std::size_t recording, std::span<T> e) const {
    for (const Channel& c : channels)
      if (c.of_worm && c.recording == recording) return of(c, e);
    return {};
  }
  /// Of the encoder that the predictor's state is corrected by: the worm's where there is one.
  const Channel& leading(std::size_t recording) const;
  double fitted() const;  ///< number of innovations that are
};

}  // namespace wormdrive
