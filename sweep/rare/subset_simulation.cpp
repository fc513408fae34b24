#include "sweep/rare/subset_simulation.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "statistics/normal.hpp"
#include "sweep/rare/normal_draws.hpp"

namespace wormdrive {
namespace {

constexpr std::uint64_t chain_length = 10;  ///< 1/0.1: the share of a level that [AuBeck2001] found cheapest
constexpr double best_acceptance = 0.44;    ///< of proposals, [Papaioannou2015, sec. 4.2]

/// Points and what the limit state says of them; a chain's follow each other at a distance of the number of chains.
struct Population {
  std::vector<NormalPoint> points;
  std::vector<double> states;
};

/// Correlation along chains of the indicator "not above the threshold": the gamma of [AuBeck2001, eq. 29].
double correlation(const Population& level, double threshold, double share) {
  const std::size_t chains = level.points.size() / chain_length;
  const auto in = [&](std::size_t chain, std::size_t step) {
    return level.states[step * chains + chain] <= threshold ? 1.0 : 0.0;
  };
  const double variance = share * (1.0 - share);
  if (!(variance > 0.0)) return 0.0;
  double gamma = 0.0;
  for (std::size_t lag = 1; lag < chain_length; ++lag) {
    double sum = 0.0;
    for (std::size_t chain = 0; chain < chains; ++chain)
      for (std::size_t step = 0; step + lag < chain_length; ++step) sum += in(chain, step) * in(chain, step + lag);
    const double covariance = sum / static_cast<double>(chains * (chain_length - lag)) - share * share;
    gamma += 2.0 * (1.0 - static_cast<double>(lag) / chain_length) * covariance / variance;
  }
  return std::max(gamma, 0.0);
}

/// Standard deviations of the coordinates; those of a population that has none are those of the normal distribution.
NormalPoint spread(const std::vector<NormalPoint>& points) {
  NormalPoint spread(points.front().size());
  for (std::size_t k = 0; k < spread.size(); ++k) {
    double mean = 0.0, square = 0.0;
    for (const NormalPoint& p : points) mean += p[k] / static_cast<double>(points.size());
    for (const NormalPoint& p : points) square += (p[k] - mean) * (p[k] - mean);
    spread[k] = std::sqrt(square / static_cast<double>(points.size() - 1));
  }
  return spread;
}

/// The probability of a point within all levels.
double share_within(std::span<const SubsetLevel> levels) {
  double share = 1.0;
  for (const SubsetLevel& level : levels) share *= level.share;
  return share;
}

class Subsets {
 public:
  Subsets(const LimitState& limit_state, std::size_t dimensions, const SubsetSettings& settings)
      : limit_state_(limit_state), dimensions_(dimensions), settings_(settings) {
    while (level_.points.size() < settings.per_level)
      level_.points.push_back(normal_draws(settings.seed, SweepStream::subset, level_.points.size(), dimensions));
    level_.states = limit_state(level_.points, indices_from(0, level_.points.size()));
    evaluations = settings.per_level;
  }

  /// Ends the present level; true if the limit lies within it.
  bool end_level(std::vector<SubsetLevel>& levels) {
    std::vector<double> sorted = level_.states;
    const std::size_t seeds = sorted.size() / chain_length;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(seeds) - 1, sorted.end());
    SubsetLevel ended{.threshold = std::max(sorted[seeds - 1], 0.0), .acceptance = acceptance_};
    const double count = static_cast<double>(sorted.size());
    const auto inside = [&](double state) { return state <= ended.threshold; };
    ended.share = static_cast<double>(std::count_if(level_.states.begin(), level_.states.end(), inside)) / count;
    const double gamma = levels.empty() ? 0.0 : correlation(level_, ended.threshold, ended.share);
    ended.variation = std::sqrt((1.0 - ended.share) / (count * ended.share) * (1.0 + gamma));
    const bool stands = !levels.empty() && ended.threshold >= levels.back().threshold;
    levels.push_back(ended);
    if (ended.threshold == 0.0) return true;
    if (stands)
      throw PlateauFault(fmt::format("comes no nearer to its limit than {:.6g} (a share of {:.1g} of the drives)",
                                     ended.threshold, share_within(levels)));
    return false;
  }

  /// Fills the next level with chains that start from the points within the threshold.
  void next_level(double threshold) {
    Population next;
    const std::size_t chains = level_.points.size() / chain_length;
    for (std::size_t k = 0; k < level_.points.size() && next.points.size() < chains; ++k)
      if (level_.states[k] <= threshold) {
        next.points.push_back(level_.points[k]);
        next.states.push_back(level_.states[k]);
      }
    const NormalPoint scale = spread(next.points);
    double taken = 0.0;
    for (std::uint64_t step = 1; step < chain_length; ++step) {
      std::vector<NormalPoint> proposed;
      for (std::size_t chain = 0; chain < chains; ++chain) {
        const NormalPoint& from = next.points[(step - 1) * chains + chain];
        NormalPoint draws = normal_draws(settings_.seed, SweepStream::subset, evaluations + chain, dimensions_);
        for (std::size_t k = 0; k < draws.size(); ++k) {
          const double sigma = std::min(1.0, step_ * scale[k]);
          draws[k] = std::sqrt(1.0 - sigma * sigma) * from[k] + sigma * draws[k];
        }
        proposed.push_back(std::move(draws));
      }
      const std::vector<double> states = limit_state_(proposed, indices_from(evaluations, chains));
      evaluations += chains;
      std::size_t accepted = 0;
      for (std::size_t chain = 0; chain < chains; ++chain) {
        const bool within = states[chain] <= threshold;
        accepted += within ? 1 : 0;
        const std::size_t before = (step - 1) * chains + chain;
        const double state = within ? states[chain] : next.states[before];
        next.points.push_back(within ? std::move(proposed[chain]) : next.points[before]);
        next.states.push_back(state);
      }
      const double share = static_cast<double>(accepted) / static_cast<double>(chains);
      taken += share / (chain_length - 1);
      step_ *= std::exp((share - best_acceptance) / std::sqrt(static_cast<double>(step)));
    }
    acceptance_ = taken;
    level_ = std::move(next);
  }

  std::uint64_t evaluations = 0;

 private:
  const LimitState& limit_state_;
  std::size_t dimensions_;
  SubsetSettings settings_;
  Population level_;
  double step_ = 0.6;  ///< of proposals, as a share of the spread of the seeds; where [Papaioannou2015] starts
  double acceptance_ = 1.0;
};

}  // namespace

std::uint64_t most_evaluations(const SubsetSettings& settings) {
  return settings.per_level + (settings.most_levels - 1) * (chain_length - 1) * (settings.per_level / chain_length);
}

RareEstimate estimate_within(std::span<const SubsetLevel> levels) {
  RareEstimate p;
  p.probability = share_within(levels);
  double square = 0.0;
  for (const SubsetLevel& level : levels) square += level.variation * level.variation;
  // of a product the logarithm is normal
  p.variation = std::sqrt(square);
  p.low = p.probability * std::exp(-normal_half_width * p.variation);
  p.high = std::min(1.0, p.probability * std::exp(normal_half_width * p.variation));
  return p;
}

SubsetResult subset_simulation(const LimitState& limit_state, std::size_t dimensions, const SubsetSettings& settings) {
  Subsets subsets(limit_state, dimensions, settings);
  SubsetResult result;
  while (!subsets.end_level(result.levels)) {
    if (result.levels.size() == settings.most_levels) break;
    subsets.next_level(result.levels.back().threshold);
  }
  result.estimate = estimate_within(result.levels);
  if (result.levels.back().threshold > 0.0) result.estimate.low = 0.0;  // rarer than all levels
  result.estimate.evaluations = subsets.evaluations;
  return result;
}

}  // namespace wormdrive
