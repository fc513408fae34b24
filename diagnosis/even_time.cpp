#include "diagnosis/even_time.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "diagnosis/robust.hpp"

namespace wormdrive {
namespace {

void refuse_disorder(const RecordedTable& table) {
  const std::vector<double>& t = table.time.values;
  const std::string& name = table.time.name;
  if (t.front() < 0.0)
    refuse(table.where(0), fmt::format("{} = {} is negative; count time from the first sample on", name, t.front()));
  for (std::size_t k = 1; k < t.size(); ++k) {
    if (t[k] == t[k - 1]) refuse(table.where(k), fmt::format("{} = {} stands twice in a row", name, t[k]));
    if (t[k] < t[k - 1]) refuse(table.where(k), fmt::format("{} = {} is before {}", name, t[k], t[k - 1]));
  }
}

}  // namespace

EvenTime even_time(const RecordedTable& table) {
  const std::vector<double>& t = table.time.values;
  const std::string& name = table.time.name;
  if (t.size() < least_samples)
    refuse(table.where(), fmt::format("{} samples; a diagnosis needs at least {}", t.size(), least_samples));
  refuse_disorder(table);
  std::vector<double> steps;
  for (std::size_t k = 1; k < t.size(); ++k) steps.push_back(t[k] - t[k - 1]);
  const double usual = median(steps);
  if (usual > longest_period)
    refuse(table.where(), fmt::format("{} has steps of {:.3g} s; a diagnosis needs at most {} s (is {} in seconds?)",
                                      name, usual, longest_period, name));
  for (std::size_t k = 0; k < steps.size(); ++k)
    if (steps[k] > 1.6 * usual)
      refuse(table.where(k + 1),
             fmt::format("{} jumps from {} to {}, where steps are {:.3g} s: {:.0f} missing; cut the recording there",
                         name, t[k], t[k + 1], usual, std::max(1.0, std::round(steps[k] / usual) - 1.0)));
  // the line through all times, by least squares
  const double middle = 0.5 * static_cast<double>(t.size() - 1);
  double mean = 0.0, slope = 0.0, squares = 0.0;
  for (const double time : t) mean += time / static_cast<double>(t.size());
  for (std::size_t k = 0; k < t.size(); ++k) {
    const double place = static_cast<double>(k) - middle;
    slope += place * (t[k] - mean);
    squares += place * place;
  }
  const double period = slope / squares, start = mean - middle * period;
  const double duration = static_cast<double>(t.size()) * period;
  if (duration < least_duration - 1e-9)
    refuse(table.where(), fmt::format("{} samples of {:.3g} s are {:.3g} s; a diagnosis needs at least {} s", t.size(),
                                      period, duration, least_duration));
  EvenTime even{start, period, {}};
  double worst = 0.0;
  std::size_t at = 0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    const double off = std::abs(t[k] - start - static_cast<double>(k) * period);
    if (off > worst) {
      worst = off;
      at = k;
    }
  }
  if (worst > even_share * period)
    refuse(table.where(at),
           fmt::format("{} = {} is {:.2g} s off the nearest even grid, whose steps are {:.4g} s; at most "
                       "{:.0f} % of a step can be taken for even",
                       name, t[at], worst, period, 100.0 * even_share));
  if (worst > 0.02 * period)
    even.remarks.push_back(fmt::format("the sample times miss an even grid by up to {:.0f} % of a step; taken for even",
                                       100.0 * worst / period));
  return even;
}

}  // namespace wormdrive
