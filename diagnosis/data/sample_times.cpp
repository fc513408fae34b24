#include "diagnosis/data/sample_times.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "diagnosis/data/recording.hpp"
#include "diagnosis/rules/recordings.hpp"

namespace wormdrive {
namespace {

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

/// The times without the pauses: across each of them, one step in place of all that are missing.
std::vector<double> with_pauses_closed(const RecordedTable& table, double step) {
  std::vector<double> t = table.time.values;
  double closed = 0.0;
  for (std::size_t k = 1, pause = 0; k < t.size(); ++k) {
    if (pause < table.restarts.size() && k == table.restarts[pause]) {
      closed += (std::round((table.time.values[k] - table.time.values[k - 1]) / step) - 1.0) * step;
      ++pause;
    }
    t[k] -= closed;
  }
  return t;
}

/// Whether the readings belong to even times, though their stamps are not even: the line through the neighbours of a
/// sample misses its angle by less halfway between them than at its stamp.
bool read_at_even_times(const RecordedTable& table, const std::vector<std::uint8_t>& there) {
  const std::vector<double>&t = table.time.values, &y = table.angle.values;
  double at_stamps = 0.0, halfway = 0.0;
  for (std::size_t k = 1; k + 1 < t.size(); ++k) {
    const auto next = std::lower_bound(table.restarts.begin(), table.restarts.end(), k);
    const bool broken = next != table.restarts.end() && *next <= k + 1;
    if (broken || !there[k - 1] || !there[k] || !there[k + 1]) continue;
    const double bend = y[k] - 0.5 * (y[k - 1] + y[k + 1]), late = t[k] - 0.5 * (t[k - 1] + t[k + 1]);
    at_stamps += std::abs(bend - late * (y[k + 1] - y[k - 1]) / (t[k + 1] - t[k - 1]));
    halfway += std::abs(bend);
  }
  return halfway < at_stamps;
}

/// The shortest and the longest of some steps.
std::pair<double, double> range(const std::vector<double>& steps) {
  const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
  return {*least, *most};
}

}  // namespace

SampleTimes sample_times(const RecordedTable& table, const MissingRows& rows) {
  const std::vector<double>& stamps = table.time.values;
  const std::vector<double> t = with_pauses_closed(table, rows.step);
  const auto [start, period] = whole_line(t);
  const double duration = static_cast<double>(t.size()) * period;
  if (duration < rules::least_duration - 1e-9)
    reject(table.where(), fmt::format("{} samples of {:.6g} s are {:.6g} s; a diagnosis needs at least {} s", t.size(),
                                      period, duration, rules::least_duration));

  SampleTimes found{start, period, {}, {}};
  if (!rows.remark.empty()) found.remarks.push_back(rows.remark);
  double jitter = 0.0, drift = 0.0;  // by which a sample misses its neighbours' line, and that one the whole [steps]
  std::vector<double> steady, steps;
  for (std::size_t k = 0; k < t.size(); ++k) {
    const Line line = line_around(t, k, rules::neighbours_of_stamp);
    found.times.push_back(line.at);
    steady.push_back(line.step);
    if (k > 0) steps.push_back(t[k] - t[k - 1]);
    jitter = std::max(jitter, std::abs(t[k] - line.at) / line.step);
    drift = std::max(drift, std::abs(line.at - start - static_cast<double>(k) * period) / period);
  }

  if (jitter > rules::even_enough && (jitter > rules::latest_stamp || !read_at_even_times(table, rows.there))) {
    const auto [shortest, longest] = range(steps);
    found.remarks.push_back(
        fmt::format("the sample times miss even steps by up to {:.0f} % of a step, which are {:.3g} "
                    "s to {:.3g} s long; followed as they are",
                    100.0 * jitter, shortest, longest));
    found.start = stamps.front();
    for (std::size_t k = 0; k < t.size(); ++k) found.times[k] = stamps[k] - stamps.front();
    return found;
  }
  if (jitter > rules::even_enough)
    found.remarks.push_back(
        fmt::format("the sample times miss even steps by up to {:.0f} % of a step; taken for even", 100.0 * jitter));
  if (drift > rules::even_enough) {
    const auto [shortest, longest] = range(steady);
    found.remarks.push_back(
        fmt::format("the steps drift between {:.6g} s and {:.6g} s, {:.2g} s off an even grid; followed as they are",
                    shortest, longest, drift * period));
    found.start = found.times.front();
    for (std::size_t k = 0; k < t.size(); ++k) found.times[k] += stamps[k] - t[k] - found.start;
  } else if (!table.restarts.empty()) {
    for (std::size_t k = 0; k < t.size(); ++k) found.times[k] = static_cast<double>(k) * period + stamps[k] - t[k];
  } else {
    found.times.clear();
  }
  return found;
}

}  // namespace wormdrive
