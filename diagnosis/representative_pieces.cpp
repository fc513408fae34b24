#include "diagnosis/representative_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wormdrive {

namespace {

struct Window {
  std::size_t begin, end;  ///< samples
};

/// Of a section the piece of a length in which the angle goes farthest.
Window liveliest(const std::vector<double>& way, std::size_t begin, std::size_t end, std::size_t length) {
  const auto goes = [&](std::size_t k) { return way[k + length - 1] - way[k]; };
  std::size_t best = begin;
  for (std::size_t k = begin; k + length <= end; ++k)
    if (goes(k) > goes(best)) best = k;
  return {best, best + length};
}

std::vector<Window> pieces_of(const Recording& recording, std::size_t most) {
  const std::size_t n = recording.samples();
  const auto length =
      std::max(rules::least_samples, static_cast<std::size_t>(std::lround(rules::piece / recording.period)));
  const std::size_t count = std::max<std::size_t>(1, most / length);
  if (n <= most || count * length >= n) return {{0, n}};
  std::vector<double> way(n);  // until a sample
  for (std::size_t k = 1; k < n; ++k)
    way[k] = way[k - 1] + std::abs(recording.gear_angle[k] - recording.gear_angle[k - 1]);
  std::vector<Window> pieces;
  for (std::size_t k = 0; k < count; ++k) pieces.push_back(liveliest(way, k * n / count, (k + 1) * n / count, length));
  return pieces;
}

/// The same recording with these pieces alone, and a pause between any two that do not touch.
Recording cut(const Recording& whole, const std::vector<Window>& pieces) {
  Recording r = whole;
  const std::size_t first = pieces.front().begin;
  r.start = whole.start + whole.time(first);
  for (auto* const column : {&r.times, &r.motor_torque, &r.gear_angle, &r.worm_angle}) column->clear();
  r.valid.clear();
  r.restarts.clear();
  const auto append = [](auto& to, const auto& from, const Window& p) {
    if (!from.empty())
      to.insert(to.end(), from.begin() + static_cast<std::ptrdiff_t>(p.begin),
                from.begin() + static_cast<std::ptrdiff_t>(p.end));
  };
  for (const Window& p : pieces) {
    if (&p != &pieces.front() && p.begin != (&p - 1)->end) r.restarts.push_back(r.gear_angle.size());
    for (const std::size_t restart : whole.restarts)
      if (restart > p.begin && restart < p.end) r.restarts.push_back(r.gear_angle.size() + restart - p.begin);
    for (std::size_t k = p.begin; k < p.end; ++k) r.times.push_back(whole.time(k) - whole.time(first));
    append(r.motor_torque, whole.motor_torque, p);
    append(r.gear_angle, whole.gear_angle, p);
    append(r.worm_angle, whole.worm_angle, p);
    append(r.valid, whole.valid, p);
  }
  return r;
}

}  // namespace

std::size_t samples_of(const std::vector<Recording>& recordings) {
  return std::accumulate(recordings.begin(), recordings.end(), std::size_t{0},
                         [](std::size_t sum, const Recording& r) { return sum + r.samples(); });
}

std::vector<Recording> representative_pieces(const std::vector<Recording>& recordings, std::size_t most) {
  const std::size_t all = samples_of(recordings);
  if (all <= most) return recordings;
  std::vector<Recording> cut_down;
  for (const Recording& r : recordings) {
    const auto share = static_cast<std::size_t>(static_cast<double>(most) * static_cast<double>(r.samples()) /
                                                static_cast<double>(all));
    const std::vector<Window> pieces = pieces_of(r, share);
    cut_down.push_back(pieces.size() == 1 && pieces.front().end == r.samples() ? r : cut(r, pieces));
  }
  return cut_down;
}

}  // namespace wormdrive
