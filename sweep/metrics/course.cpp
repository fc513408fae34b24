#include "sweep/metrics/course.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wormdrive {
namespace {

using Point = Course::Point;

/// Calls visit(begin, end) for every straight line, jumps among them.
template <class Visit>
void for_each_line(const std::vector<Point>& points, Visit&& visit) {
  for (std::size_t k = 1; k < points.size(); ++k) visit(points[k - 1], points[k]);
}

/// When a line from a to b is at a level between their values.
double time_at(const Point& a, const Point& b, double level) { return a.t + (level - a.y) / (b.y - a.y) * (b.t - a.t); }

double value_at(const Point& a, const Point& b, double t) {
  return b.t > a.t ? a.y + (t - a.t) / (b.t - a.t) * (b.y - a.y) : b.y;
}

}  // namespace

Course Course::between(double from, double to) const {
  Course part;
  if (empty() || from > points.back().t || to < begin()) return part;
  const bool cut = from > begin();
  if (cut) part.points.push_back({from, at(from)});
  const bool ends_before = to < points.back().t;
  for (const Point& p : points)
    if ((!cut || p.t > from) && (ends_before ? p.t < to : p.t <= to)) part.points.push_back(p);
  if (ends_before) {  // as it is before a jump there
    const auto there =
        std::lower_bound(points.begin(), points.end(), to, [](const Point& p, double t) { return p.t < t; });
    part.points.push_back({to, there->t == to ? there->y : at(to)});
  }
  return part;
}

double Course::at(double t) const {
  const auto after =
      std::upper_bound(points.begin(), points.end(), t, [](double x, const Point& p) { return x < p.t; });
  if (after == points.begin() || after == points.end()) return (after == points.end() ? points.back() : *after).y;
  return value_at(*(after - 1), *after, t);
}

double Course::least() const {
  return std::min_element(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.y < b.y; })->y;
}
double Course::greatest() const {
  return std::max_element(points.begin(), points.end(), [](const Point& a, const Point& b) { return a.y < b.y; })->y;
}

double Course::integral() const {
  double sum = 0.0;
  for_each_line(points, [&](const Point& a, const Point& b) { sum += 0.5 * (a.y + b.y) * (b.t - a.t); });
  return sum;
}
double Course::mean() const { return duration() > 0.0 ? integral() / duration() : points.back().y; }
double Course::root_mean_square() const {
  if (!(duration() > 0.0)) return std::abs(points.back().y);
  double sum = 0.0;
  for_each_line(
      points, [&](const Point& a, const Point& b) { sum += (a.y * a.y + a.y * b.y + b.y * b.y) / 3.0 * (b.t - a.t); });
  return std::sqrt(sum / duration());
}

double Course::quantile(double share) const {
  if (!(duration() > 0.0)) return points.back().y;
  // but for the rounding of a sum of so many times
  const double wanted =
      (share - std::numeric_limits<double>::epsilon() * static_cast<double>(points.size())) * duration();
  const auto time_below = [&](double level) {
    double sum = 0.0;
    for_each_line(points, [&](const Point& a, const Point& b) {
      const double low = std::min(a.y, b.y), high = std::max(a.y, b.y);
      sum += (b.t - a.t) * (high <= level ? 1.0 : low > level ? 0.0 : (level - low) / (high - low));
    });
    return sum;
  };
  double low = least(), high = greatest();
  if (share >= 1.0) return high;
  if (time_below(low) >= wanted) return low;
  for (;;) {
    const double middle = low + 0.5 * (high - low);
    if (middle <= low || middle >= high) return high;
    (time_below(middle) >= wanted ? high : low) = middle;
  }
}

double Course::crossing(double level, bool rising, bool falling, int n) const {
  double found = std::numeric_limits<double>::quiet_NaN();
  for_each_line(points, [&](const Point& a, const Point& b) {
    const bool rises = a.y < level && b.y >= level, falls = a.y > level && b.y <= level;
    if (n > 0 && ((rising && rises) || (falling && falls)) && --n == 0) found = time_at(a, b, level);
  });
  return found;
}

double Course::settling(double target, double band) const {
  const auto outside = [&](const Point& p) { return std::abs(p.y - target) > band; };
  if (outside(points.back())) return std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = points.size() - 1; k-- > 0;)
    if (outside(points[k]))
      return time_at(points[k], points[k + 1], target + std::copysign(band, points[k].y - target)) - begin();
  return 0.0;
}

}  // namespace wormdrive
