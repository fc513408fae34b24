#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "diagnosis/data/prepared_recording.hpp"
#include "diagnosis/rules/noise.hpp"

namespace wormdrive {

using WhiteningWeights = std::array<double, rules::whitening_times.size()>;

/// Noise of samples of one kind: of one recording, standing or moving.
struct NoiseGroup {
  double scale = 1.0;                    ///< of Student's t [rad]
  double freedom = rules::tail_freedom;  ///< its degrees of freedom, more where there is hardly any noise but rounding
  WhiteningWeights weights{};
};

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

/// The noise as estimated from the fitted samples of innovations.
struct NoiseModel {
  std::vector<NoiseGroup> groups{};
  bool whitens = true;  ///< false: the weights are zero
};

/// Whether whitening takes more than half of a steady innovation while moving for noise, in any recording.
bool hides_what_is_slow(const NoiseModel& noise);

/// What innovations come to under a noise model, negative log likelihoods in nats.
struct Misfit {
  double fitted = 0.0, held_out = 0.0;
  std::vector<double> blocks{};  ///< of every block, fitted or held out
};

/// Scales and whitening weights that make the fitted samples most likely, by reweighted least squares.
NoiseModel estimate_noise(const InnovationLayout& layout, std::span<const double> innovations, bool whitens);

/// Innovations less what the ones before predict of them.
std::vector<double> whitened(const InnovationLayout& layout, std::span<const double> innovations,
                             const NoiseModel& noise);

/// Innovations as random as the noise model takes them: the whitened ones in another order, with signs drawn, samples
/// of one kind among themselves, and coloured as they were.
std::vector<double> drawn_innovations(const InnovationLayout& layout, std::span<const double> whitened,
                                      const NoiseModel& noise, std::uint64_t seed);

/// Of whitened innovations.
Misfit misfit(const InnovationLayout& layout, std::span<const double> whitened, const NoiseModel& noise);

/// Curvature with which a whitened innovation enters reweighted least squares, 0 where it is not fitted.
std::vector<double> fit_weights(const InnovationLayout& layout, std::span<const double> whitened,
                                const NoiseModel& noise);

}  // namespace wormdrive
