#include "diagnosis/data/sample_times.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include <fmt/format.h>

#include "diagnosis/data/recording.hpp"
#include "diagnosis/rules/recordings.hpp"
#include "statistics/robust.hpp"

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

/// The line through times at places of a grid by least squares, as it begins; weights: of the squares.
Line line_through(const std::vector<double>& t, const std::vector<double>& places, const std::vector<double>& weights) {
  double sum = 0.0, middle = 0.0, mean = 0.0, slope = 0.0, squares = 0.0;
  for (std::size_t k = 0; k < t.size(); ++k) {
    sum += weights[k];
    middle += weights[k] * places[k];
    mean += weights[k] * t[k];
  }
  middle /= sum;
  mean /= sum;
  for (std::size_t k = 0; k < t.size(); ++k) {
    slope += weights[k] * (places[k] - middle) * (t[k] - mean);
    squares += weights[k] * (places[k] - middle) * (places[k] - middle);
  }
  return {mean - middle * slope / squares, slope / squares};
}

/// 0, 1, 2, ...
std::vector<double> rows_in_turn(std::size_t rows) {
  std::vector<double> places(rows);
  std::iota(places.begin(), places.end(), 0.0);
  return places;
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

/// The step that most stretches of rows have on average [s]: missing rows are in few of them, and roundings average
/// out.
double mean_step(const std::vector<double>& t) {
  constexpr std::size_t rows = 20;
  std::vector<double> steps;
  for (std::size_t k = rows; k < t.size(); ++k) steps.push_back((t[k] - t[k - rows]) / static_cast<double>(rows));
  return median(std::move(steps));
}

/// How far each stamp may be from the time that it was rounded from [s].
std::vector<double> roundings(const std::vector<double>& stamps) {
  constexpr int most_digits = 9;
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const auto decade = [](double t) { return static_cast<int>(std::floor(std::log10(std::max(t, 1e-9)))); };
  const auto is_whole = [](double x) { return std::abs(x - std::round(x)) < 1e-6; };
  const bool single = std::all_of(stamps.begin(), stamps.end(), [](double t) { return t == static_cast<float>(t); });
  std::map<int, int> decimals;  // where digits are significant, the fewer the longer a recording lasts
  for (const double t : stamps) {
    int& digits = decimals[decade(t)];
    while (digits < most_digits && !is_whole(t * std::pow(10.0, digits))) ++digits;
  }
  std::vector<double> all;
  for (const double t : stamps) {
    const auto f = static_cast<float>(t);
    const double by_precision = single ? static_cast<double>(std::nextafter(f, infinity) - f) : 0.0;
    all.push_back(0.5 * std::max(std::pow(10.0, -decimals[decade(t)]), by_precision));
  }
  return all;
}

/// Where each stamp stands in an even grid, if every stamp is at most its rounding off that grid's time: counted by the
/// rows, or by the time between them where rows are missing. Gives the times of the grid.
std::optional<std::vector<double>> grid_behind(const std::vector<double>& stamps, const std::vector<double>& places,
                                               const std::vector<double>& rounding) {
  std::vector<double> weights, grid;
  for (const double most : rounding) weights.push_back(1.0 / (most * most));
  const Line line = line_through(stamps, places, weights);
  for (std::size_t k = 0; k < stamps.size(); ++k) {
    grid.push_back(line.at + places[k] * line.step);
    constexpr double of_the_line = 1.6;  // ties that go up here and down there move it by half a rounding
    if (std::abs(grid[k] - stamps[k]) > of_the_line * rounding[k]) return std::nullopt;
    // two neighbours are rounded by less than a whole one from each other: one that stands twice is another fault
    constexpr double less_than_two = 1.998;
    if (k > 0 && std::abs(grid[k] - grid[k - 1] - stamps[k] + stamps[k - 1]) > less_than_two * rounding[k])
      return std::nullopt;
  }
  grid.front() = std::max(0.0, grid.front());
  return grid;
}

/// The shortest and the longest of some steps.
std::pair<double, double> range(const std::vector<double>& steps) {
  const auto [least, most] = std::minmax_element(steps.begin(), steps.end());
  return {*least, *most};
}

}  // namespace

std::optional<std::string> even_out_rounded_stamps(RecordedTable& table) {
  std::vector<double>& stamps = table.time.values;
  if (stamps.size() < rules::least_samples || !std::is_sorted(stamps.begin(), stamps.end())) return std::nullopt;
  const double step = mean_step(stamps);
  const std::vector<double> rounding = roundings(stamps);
  const double coarsest = 2.0 * rounding.back();
  if (stamps.front() < 0.0 || coarsest <= rules::even_enough * step) return std::nullopt;
  std::vector<double> by_rows = rows_in_turn(stamps.size()), by_time{0.0};
  for (std::size_t k = 1; k < stamps.size(); ++k)
    by_time.push_back(by_time.back() + std::max(1.0, std::round((stamps[k] - stamps[k - 1]) / step)));
  for (const std::vector<double>* places : {&by_rows, &by_time})
    if (auto grid = grid_behind(stamps, *places, rounding)) {
      double off = 0.0;
      for (std::size_t k = 0; k < stamps.size(); ++k) off = std::max(off, std::abs((*grid)[k] - stamps[k]));
      if (off <= rules::even_enough * step) return std::nullopt;
      stamps = std::move(*grid);
      return fmt::format("the sample times are rounded to {:.2g} s, of steps of {:.6g} s; taken for even", coarsest,
                         (stamps.back() - stamps.front()) / places->back());
    }
  return std::nullopt;
}

SampleTimes sample_times(const RecordedTable& table, const MissingRows& rows) {
  const std::vector<double>& stamps = table.time.values;
  const std::vector<double> t = with_pauses_closed(table, rows.step);
  const auto [start, period] = line_through(t, rows_in_turn(t.size()), std::vector<double>(t.size(), 1.0));
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
