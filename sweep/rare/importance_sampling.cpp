#include "sweep/rare/importance_sampling.hpp"

#include <cmath>
#include <numeric>

#include "statistics/normal.hpp"
#include "sweep/rare/normal_draws.hpp"

namespace wormdrive {

RareEstimate importance_sampling(const LimitState& limit_state, const NormalPoint& around,
                                 const ImportanceSettings& settings) {
  const double square = std::inner_product(around.begin(), around.end(), around.begin(), 0.0);
  std::vector<NormalPoint> points;
  std::vector<double> weights;
  for (std::uint64_t k = 0; k < settings.samples; ++k) {
    NormalPoint u = normal_draws(settings.seed, SweepStream::importance, k, around.size());
    weights.push_back(std::exp(-std::inner_product(u.begin(), u.end(), around.begin(), 0.0) - 0.5 * square));
    for (std::size_t j = 0; j < u.size(); ++j) u[j] += around[j];
    points.push_back(std::move(u));
  }
  const std::vector<double> states = limit_state(points, indices_from(settings.first, points.size()));
  const double count = static_cast<double>(settings.samples);
  double sum = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < states.size(); ++k) {
    const double part = states[k] <= 0.0 ? weights[k] : 0.0;
    sum += part;
    squares += part * part;
  }
  RareEstimate p{.probability = sum / count, .evaluations = settings.samples};
  const double variance = (squares / count - p.probability * p.probability) / (count - 1.0);
  p.variation = p.probability > 0.0 ? std::sqrt(std::max(variance, 0.0)) / p.probability : 0.0;
  p.low = std::max(0.0, p.probability * (1.0 - normal_half_width * p.variation));
  p.high = std::min(1.0, p.probability * (1.0 + normal_half_width * p.variation));
  return p;
}

}  // namespace wormdrive
