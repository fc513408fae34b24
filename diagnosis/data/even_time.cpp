#include "diagnosis/data/even_time.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "diagnosis/data/recording.hpp"
#include "statistics/robust.hpp"

namespace wormdrive {
namespace {

void refuse_disorder(const RecordedTable& table) {
  const std::vector<double>& t = table.time.values;
  const std::string& name = table.time.name;
  if (t.front() < 0.0)
    reject(table.where(0), fmt::format("{} = {} is negative; count time from the first sample on", name, t.front()));
  for (std::size_t k = 1; k < t.size(); ++k) {
    if (t[k] == t[k - 1]) reject(table.where(k), fmt::format("{} = {} stands twice in a row", name, t[k]));
    if (t[k] < t[k - 1]) reject(table.where(k), fmt::format("{} = {} is before {}", name, t[k], t[k - 1]));
  }
}

void refuse_gaps(const RecordedTable& table, double usual) {
  const std::vector<double>& t = table.time.values;
  for (std::size_t k = 1; k < t.size(); ++k)
    if (const double step = t[k] - t[k - 1]; step > 1.6 * usual)
      reject(table.where(k),
             fmt::format("{} jumps from {} to {}, where steps are {:.3g} s: {:.0f} missing; cut the recording there",
                         table.time.name, t[k - 1], t[k], usual, std::max(1.0, std::round(step / usual) - 1.0)));
}

/// A straight line through neighbouring times.
struct Line {
  double at;    ///< of the sample that is asked for [s]
  double step;  ///< [s]
};

/// The line through as many samples on either side, by least squares; at the ends the one of the first or last sample
/// that has so many.
Line line_around(const std::vector<double>& t, std::size_t k, std::size_t half_width) {
  const std::size_t w = std::min(half_width, (t.size() - 1) / 2), middle = std::clamp(k, w, t.size() - 1 - w);
  double mean = 0.0, slope = 0.0, squares = 0.0;
  for (std::size_t j = middle - w; j <= middle + w; ++j) {
    const double place = static_cast<double>(j) - static_cast<double>(middle), later = t[j] - t[middle];
    mean += later / static_cast<double>(2 * w + 1);
    slope += place * later;
    squares += place * place;
  }
  const double step = slope / squares;
  return {t[middle] + mean + step * (static_cast<double>(k) - static_cast<double>(middle)), step};
}

/// The line through all times, as it begins.
Line whole_line(const std::vector<double>& t) {
  const double middle = 0.5 * static_cast<double>(t.size() - 1);
  double mean = 0.0, slope = 0.0, squares = 0.0;
  for (const double time : t) mean += time / static_cast<double>(t.size());
  for (std::size_t k = 0; k < t.size(); ++k) {
    const double place = static_cast<double>(k) - middle;
    slope += place * (t[k] - mean);
    squares += place * place;
  }
  return {mean - middle * slope / squares, slope / squares};
}

}  // namespace

EvenTime even_time(const RecordedTable& table) {
  const std::vector<double>& t = table.time.values;
  const std::string& name = table.time.name;
  if (t.size() < least_samples)
    reject(table.where(), fmt::format("{} samples; a diagnosis needs at least {}", t.size(), least_samples));
  refuse_disorder(table);
  std::vector<double> steps;
  for (std::size_t k = 1; k < t.size(); ++k) steps.push_back(t[k] - t[k - 1]);
  const double usual = median(std::move(steps));
  if (usual > longest_period)
    reject(table.where(), fmt::format("{} has steps of {:.3g} s; a diagnosis needs at most {} s (is {} in seconds?)",
                                      name, usual, longest_period, name));
  refuse_gaps(table, usual);
  const auto [start, period] = whole_line(t);
  const double duration = static_cast<double>(t.size()) * period;
  if (duration < least_duration - 1e-9)
    reject(table.where(), fmt::format("{} samples of {:.3g} s are {:.3g} s; a diagnosis needs at least {} s", t.size(),
                                      period, duration, least_duration));

  constexpr std::size_t neighbours = 50;  // on either side: a drift bends their line by nothing, one step by itself
  EvenTime even{start, period, {}, {}};
  double drift = 0.0;
  std::vector<double> steady, jitter, change;  // step around a sample, shares by which the sample and that step miss
  for (std::size_t k = 0; k < t.size(); ++k) {
    const Line line = line_around(t, k, neighbours);
    even.times.push_back(line.at);
    steady.push_back(line.step);
    jitter.push_back(std::abs(t[k] - line.at) / line.step);
    change.push_back(std::abs(line.step - period) / period);
    drift = std::max(drift, std::abs(line.at - start - static_cast<double>(k) * period) / period);
  }
  const auto worst = [](const std::vector<double>& shares) {
    return static_cast<std::size_t>(std::max_element(shares.begin(), shares.end()) - shares.begin());
  };
  const std::size_t jumps = worst(jitter), hurries = worst(change);
  if (jitter[jumps] > even_share)
    reject(table.where(jumps),
           fmt::format("{} = {} is {:.2g} s off the even steps of {:.4g} s around it; at most {:.0f} "
                       "% of a step can be taken for even",
                       name, t[jumps], std::abs(t[jumps] - even.times[jumps]), steady[jumps], 100.0 * even_share));
  if (change[hurries] > even_share)
    reject(table.where(hurries),
           fmt::format("{} has steps of {:.4g} s at {} and of {:.4g} s on average; at most {:.0f} % "
                       "apart they can be one recording",
                       name, steady[hurries], t[hurries], period, 100.0 * even_share));
  if (jitter[jumps] > even_enough)
    even.remarks.push_back(fmt::format("the sample times miss even steps by up to {:.0f} % of a step; taken for even",
                                       100.0 * jitter[jumps]));
  if (drift <= even_enough) {
    even.times.clear();
    return even;
  }
  even.remarks.push_back(
      fmt::format("the steps drift between {:.6g} s and {:.6g} s, {:.2g} s off an even grid; followed "
                  "as they are",
                  *std::min_element(steady.begin(), steady.end()), *std::max_element(steady.begin(), steady.end()),
                  drift * period));
  even.start = even.times.front();
  for (double& time : even.times) time -= even.start;
  return even;
}

}  // namespace wormdrive
