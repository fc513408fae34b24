#include "diagnosis/predictor/noise_tails.hpp"

#include <algorithm>

namespace wormdrive {

namespace {

/// Degrees of freedom with which errors within one scale weigh nearly alike.
constexpr double alike_within_step = (1.0 - rules::unequal_within_step) / rules::unequal_within_step;

/// Degrees of freedom with which errors within half a step of the encoder weigh nearly alike, the usual ones at least.
double freedom_within_step(double scale, double resolution) {
  const double half_step = 0.5 * resolution / scale;
  return std::max(rules::tail_freedom, alike_within_step * half_step * half_step);
}

double iterated_scale(const std::vector<Square>& squares, double scale, double nu, double least) {
  double sum = 0.0, count = 0.0;
  const double inverse = 1.0 / (scale * scale);
  for (const Square& q : squares) {
    sum += q.share * (nu + 1.0) * q.value / (nu + q.value * inverse);
    count += q.share;
  }
  return std::max(least, std::sqrt(sum / count));
}

}  // namespace

void fit_scale_and_tails(NoiseGroup& group, const std::vector<Square>& squares, double least, double resolution,
                         int rounds) {
  for (int k = 0; k < rounds && (k == 0 || group.scale > least); ++k)
    group.scale = iterated_scale(squares, group.scale, rules::tail_freedom, least);
  group.freedom = rules::tail_freedom;
  if (freedom_within_step(group.scale, resolution) <= rules::tail_freedom) return;
  NoiseGroup rounding = group;
  for (int k = 0; k < rounds; ++k) {
    rounding.freedom = freedom_within_step(rounding.scale, resolution);
    rounding.scale = iterated_scale(squares, rounding.scale, rounding.freedom, least);
  }
  if (NegativeLogLikelihood(rounding)(squares) < NegativeLogLikelihood(group)(squares)) group = rounding;
}

bool mostly_rounding(const NoiseModel& noise) {
  constexpr double square_of_half_step = 3.0 * rules::mere_rounding;  // of an error with the variance of a step / 12
  for (std::size_t g = 1; g < noise.groups.size(); g += 2)
    if (noise.groups[g].freedom > alike_within_step * square_of_half_step) return true;
  return false;
}

}  // namespace wormdrive
