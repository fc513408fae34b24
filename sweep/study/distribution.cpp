#include "sweep/study/distribution.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "statistics/beta.hpp"
#include "statistics/normal.hpp"

namespace wormdrive {
namespace {

std::string refusal_of_limits(double low, double high) {
  return low < high ? "" : fmt::format("low = {} must be less than high = {}", low, high);
}
std::string refusal_of_limits(double low, double mode, double high) {
  if (low < high && low <= mode && mode <= high) return "";
  return fmt::format("low = {}, mode = {}, high = {} must not decrease, and low must be less than high", low, mode,
                     high);
}

/// Of equally likely values the one at a probability.
double equally_likely(const std::vector<double>& values, double u) {
  const auto k = static_cast<std::size_t>(u * static_cast<double>(values.size()));
  return values[std::min(k, values.size() - 1)];
}

}  // namespace

std::string Uniform::refusal() const { return refusal_of_limits(low, high); }

double Normal::quantile(double u) const { return mean + deviation * normal_quantile(u); }

std::string TruncatedNormal::refusal() const {
  if (!(low < high)) return refusal_of_limits(low, high);
  const double a = (low - mean) / deviation, b = (high - mean) / deviation;
  const double nearest = a > 0.0 ? a : b < 0.0 ? -b : 0.0;
  if (nearest <= 30.0) return "";
  return fmt::format("low to high lies {:.3g} deviations away from the mean; at most 30 are allowed", nearest);
}

double TruncatedNormal::quantile(double u) const {
  // In the upper tail probabilities crowd near 1: there the mirror image is taken.
  const bool mirrored = low > mean;
  const double a = (mirrored ? mean - high : low - mean) / deviation;
  const double b = (mirrored ? mean - low : high - mean) / deviation;
  const double below = std::isinf(a) ? 0.0 : normal_probability(a), to = std::isinf(b) ? 1.0 : normal_probability(b);
  const double p = below + (mirrored ? 1.0 - u : u) * (to - below);
  const double z = std::clamp(p > 0.0 && p < 1.0 ? normal_quantile(p) : (p > 0.0 ? b : a), a, b);
  return std::clamp(mean + deviation * (mirrored ? -z : z), low, high);
}

double Lognormal::quantile(double u) const { return median * portable::exp(log_deviation * normal_quantile(u)); }

std::string Triangular::refusal() const { return refusal_of_limits(low, mode, high); }

double Triangular::quantile(double u) const {
  const double width = high - low, rise = mode - low, fall = high - mode;
  return u * width < rise ? low + std::sqrt(u * width * rise) : high - std::sqrt((1.0 - u) * width * fall);
}

std::string LogUniform::refusal() const { return refusal_of_limits(low, high); }

double LogUniform::quantile(double u) const {
  // from the nearer end, which is met exactly
  const double width = portable::log(high) - portable::log(low);
  const double value = u <= 0.5 ? low * portable::exp(u * width) : high * portable::exp((u - 1.0) * width);
  return std::clamp(value, low, high);
}

std::string Beta::refusal() const { return refusal_of_limits(low, high); }

double Beta::quantile(double u) const {
  const double width = high - low;
  const double value = u <= 0.5 ? low + width * lower_beta_quantile(alpha, beta, u)
                                : high - width * lower_beta_quantile(beta, alpha, 1.0 - u);
  return std::clamp(value, low, high);
}

std::string Pert::refusal() const { return refusal_of_limits(low, mode, high); }

double Pert::quantile(double u) const {
  const double rise = (mode - low) / (high - low), fall = (high - mode) / (high - low);
  return Beta{1.0 + 4.0 * rise, 1.0 + 4.0 * fall, low, high}.quantile(u);
}

double Gumbel::quantile(double u) const {
  // near 1 the distance to 1 is what counts
  const double minus_log = u < 0.5 ? -portable::log(u) : -log_of_complement(1.0 - u);
  return mode - scale * portable::log(minus_log);
}

double Weibull::quantile(double u) const { return low + scale * portable::pow(-log_of_complement(u), 1.0 / shape); }

double Empirical::quantile(double u) const { return equally_likely(values, u); }
double RowOfFile::quantile(double u) const { return equally_likely(values, u); }

std::string Discrete::refusal() const {
  if (values.empty()) return "values must hold at least one number";
  if (weights.empty()) return "";
  if (weights.size() != values.size())
    return fmt::format("weights has {} numbers but values has {}; state equally many", weights.size(), values.size());
  for (const double weight : weights)
    if (!(weight >= 0.0)) return fmt::format("weights must not be negative, but {} is", weight);
  return std::accumulate(weights.begin(), weights.end(), 0.0) > 0.0 ? "" : "one of the weights must be greater than 0";
}

double Discrete::quantile(double u) const {
  if (weights.empty()) return equally_likely(values, u);
  double left = u * std::accumulate(weights.begin(), weights.end(), 0.0);
  std::size_t last = 0;  // with a weight: rounding must not choose one without
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (weights[k] <= 0.0) continue;
    last = k;
    if (left < weights[k]) break;
    left -= weights[k];
  }
  return values[last];
}

Discrete Discrete::each_once() const {
  Discrete once;
  for (const double value : values)
    if (std::find(once.values.begin(), once.values.end(), value) == once.values.end()) once.values.push_back(value);
  return once;
}

std::string QuantileTable::refusal() const {
  if (values.size() < 2 || values.size() != probabilities.size())
    return fmt::format("values has {} numbers but probabilities has {}; state equally many, at least 2", values.size(),
                       probabilities.size());
  if (probabilities.front() != 0.0 || probabilities.back() != 1.0)
    return fmt::format("probabilities run from {} to {}; they must run from 0 to 1", probabilities.front(),
                       probabilities.back());
  for (std::size_t k = 1; k < values.size(); ++k) {
    if (!(probabilities[k] > probabilities[k - 1]))
      return fmt::format("probabilities must increase, but {} follows {}", probabilities[k], probabilities[k - 1]);
    if (values[k] < values[k - 1])
      return fmt::format("values must not decrease, but {} follows {}", values[k], values[k - 1]);
  }
  return "";
}

double QuantileTable::quantile(double u) const {
  const auto next = std::upper_bound(probabilities.begin(), probabilities.end() - 1, u);
  const auto k = static_cast<std::size_t>(next - probabilities.begin());
  const double share = (u - probabilities[k - 1]) / (probabilities[k] - probabilities[k - 1]);
  return values[k - 1] + share * (values[k] - values[k - 1]);
}

bool only_whole_numbers(const Distribution& distribution) {
  const auto are_whole = [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return v == std::round(v); });
  };
  if (const auto* const discrete = std::get_if<Discrete>(&distribution)) return are_whole(discrete->values);
  if (const auto* const empirical = std::get_if<Empirical>(&distribution)) return are_whole(empirical->values);
  if (const auto* const row = std::get_if<RowOfFile>(&distribution)) return are_whole(row->values);
  return false;
}

}  // namespace wormdrive
