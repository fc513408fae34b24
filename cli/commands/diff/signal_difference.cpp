#include "cli/commands/diff/signal_difference.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wormdrive {
namespace {

double distance_of(double x, double y) {
  if (x == y || (std::isnan(x) && std::isnan(y))) return 0.0;
  return std::isfinite(x) && std::isfinite(y) ? std::abs(x - y) : std::numeric_limits<double>::infinity();
}

}  // namespace

SignalDifference signal_difference(const std::string& signal, const std::vector<double>& first,
                                   const std::vector<double>& second, const ComparedRows& rows,
                                   const DiffOptions& allowed) {
  SignalDifference result{signal};
  if (rows.places.texts.empty()) result.at.assign(rows.places.numbers.size(), 0.0);
  double size = 0.0;
  for (std::size_t k = 0; k < rows.pairs.size(); ++k) {
    const double x = first[rows.pairs[k].first], y = second[rows.pairs[k].second];
    for (const double value : {x, y})
      if (std::isfinite(value)) size = std::max(size, std::abs(value));
    if (!rows.left_out.empty() && rows.left_out[k]) continue;
    const double distance = distance_of(x, y);
    if (distance <= result.largest) continue;
    result.largest = distance;
    result.at = rows.places[rows.pairs[k].first];
  }
  // below infinity, which would allow everything, also where a product overflows
  result.allowed = std::min(allowed.absolute + allowed.relative * size, std::numeric_limits<double>::max());
  return result;
}

double largest_change(const std::vector<double>& times, const std::vector<double>& values, double within) {
  double largest = 0.0;
  for (std::size_t k = 1; k < times.size(); ++k)
    largest =
        std::max(largest, std::abs(values[k] - values[k - 1]) * std::min(1.0, within / (times[k] - times[k - 1])));
  return largest;
}

}  // namespace wormdrive
