#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "diagnosis/predictor/innovation_layout.hpp"
#include "diagnosis/rules/noise.hpp"

namespace wormdrive {

using WhiteningWeights = std::array<double, rules::whitening_times.size()>;

/// Noise of samples of one kind: of one recording, standing or moving.
struct NoiseGroup {
  double scale = 1.0;                    ///< of Student's t [rad]
  double freedom = rules::tail_freedom;  ///< its degrees of freedom, more where there is hardly any noise but rounding
  WhiteningWeights weights{};
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
