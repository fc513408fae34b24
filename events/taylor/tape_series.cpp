#include "events/taylor/tape_series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace wormdrive {
namespace {

using Operation = Tape::Operation;

/// Bounds of cosh r - 1 and sinh r up to the widest disc: series whose last term makes up for the rest.
struct Growth {
  double cosh_less_1, sinh;

  explicit Growth(double r) {
    const double w = r * r;
    cosh_less_1 = 0.5 * w * (1.0 + w * (1.0 / 12) * (1.0 + w * (1.0 / 30) * (1.0 + w * (1.1 / 56))));
    sinh = r * (1.0 + w * (1.0 / 6) * (1.0 + w * (1.0 / 20) * (1.0 + w * (1.1 / 42))));
  }
};

double product(const double* a, const double* b, int k) {
  double sum = a[0] * b[k];
  for (int j = 1; j <= k; ++j) sum += a[j] * b[k - j];
  return sum;
}
/// Coefficient k - 1 of a' b, times k.
double chain(const double* a, const double* b, int k) {
  double sum = 0.0;
  for (int j = 1; j <= k; ++j) sum += static_cast<double>(j) * a[j] * b[k - j];
  return sum;
}

}  // namespace

TapeSeries::TapeSeries(const Tape& tape)
    : tape_(tape), series_(static_cast<std::size_t>(tape.places())), radii_(series_.size()) {
  for (const Tape::Step& s : tape.steps())
    if (s.operation == Operation::table) sections_.push_back({.table = s.table, .place = s.a});
}

void TapeSeries::work_out(int k, std::size_t operations) {
  const auto place = [this](int n) { return series_[static_cast<std::size_t>(n)].data(); };
  Section* section = sections_.data();
  const Tape::Step* step = tape_.steps().data();
  for (const Tape::Step* const end = step + operations; step != end; ++step) {
    const double* const a = place(step->a);
    const double* const b = place(step->b);
    double* const r = place(step->result);
    switch (step->operation) {
      case Operation::add: r[k] = a[k] + b[k]; break;
      case Operation::subtract: r[k] = a[k] - b[k]; break;
      case Operation::multiply: r[k] = product(a, b, k); break;
      case Operation::shift: r[k] = k == 0 ? a[0] + step->constant : a[k]; break;
      case Operation::scale: r[k] = step->constant * a[k]; break;
      case Operation::divide:
      case Operation::invert: {
        const bool inverts = step->operation == Operation::invert;
        const double* const divisor = inverts ? a : b;
        double rest = !inverts ? a[k] : k == 0 ? step->constant : 0.0;
        for (int j = 0; j < k; ++j) rest -= r[j] * divisor[k - j];
        r[k] = rest / divisor[0];
        break;
      }
      case Operation::sine_cosine: {
        double* const cosine = place(step->result + 1);
        if (k == 0) {
          const SineAndCosine start = sine_and_cosine(a[0]);
          r[0] = start.sine;
          cosine[0] = start.cosine;
        } else {
          const double rises = chain(a, cosine, k), falls = chain(a, r, k);
          r[k] = rises * reciprocal[static_cast<std::size_t>(k)];
          cosine[k] = -falls * reciprocal[static_cast<std::size_t>(k)];
        }
        break;
      }
      case Operation::exponential:
        r[k] = k == 0 ? portable::exp(a[0]) : chain(a, r, k) * reciprocal[static_cast<std::size_t>(k)];
        break;
      case Operation::square_root: {
        double rest = a[k];
        for (int j = 1; j < k; ++j) rest -= r[j] * r[k - j];
        r[k] = k == 0 ? std::sqrt(a[0]) : rest / (2.0 * r[0]);
        break;
      }
      case Operation::table: {
        if (k == 0) section->find(a[0]);
        if (k == 1) section->turn_to(a[0], a[1]);
        const CubicTable::Cubic& c = section->cubic;
        // value + s (slope + s (second + s third)), with s = a - begin
        double* const mean = place(step->result + 1);  // what the outer bracket comes to
        const double s = a[0] - c.begin, inner = c.second + s * c.third;
        if (k == 0) {
          mean[0] = c.slope + s * inner;
          r[0] = c.value + s * mean[0];
        } else {
          if (k == 1) mean[0] = c.slope + s * inner;
          double bracket = a[k] * inner + s * (c.third * a[k]), result = a[k] * mean[0];
          for (int j = 1; j < k; ++j) bracket += a[j] * (c.third * a[k - j]);
          mean[k] = bracket;
          for (int j = 1; j < k; ++j) result += a[j] * mean[k - j];
          r[k] = result + s * bracket;
        }
        ++section;
        break;
      }
    }
  }
}

void TapeSeries::work_out_discs() {
  const auto value = [this](int n) { return series_[static_cast<std::size_t>(n)][0]; };
  const Section* section = sections_.data();
  for (const Tape::Step& s : tape_.steps()) {
    const double ra = radius(s.a), rb = radius(s.b);
    double& r = radius(s.result);
    switch (s.operation) {
      case Operation::add:
      case Operation::subtract: r = ra + rb; break;
      case Operation::multiply: r = std::abs(value(s.a)) * rb + ra * (std::abs(value(s.b)) + rb); break;
      case Operation::shift: r = ra; break;
      case Operation::scale: r = std::abs(s.constant) * ra; break;
      case Operation::divide:
      case Operation::invert: {
        const bool inverts = s.operation == Operation::invert;
        const double least = inverts ? std::abs(value(s.a)) - ra : std::abs(value(s.b)) - rb;
        const double strays = std::abs(value(s.result)) * (inverts ? ra : rb) + (inverts ? 0.0 : ra);
        r = strays / std::max(least, 0.5 * std::abs(value(inverts ? s.a : s.b)));
        break;
      }
      case Operation::sine_cosine: {
        const Growth grows(ra);
        const double sine = std::abs(value(s.result)), cosine = std::abs(value(s.result + 1));
        r = cosine * grows.sinh + sine * grows.cosh_less_1;
        radius(s.result + 1) = sine * grows.sinh + cosine * grows.cosh_less_1;
        break;
      }
      case Operation::exponential: {
        const Growth grows(ra);
        r = value(s.result) * (grows.sinh + grows.cosh_less_1);
        break;
      }
      case Operation::square_root: r = ra / value(s.result); break;  // |sqrt(x + z) - sqrt(x)| <= |z|/sqrt(x)
      case Operation::table: r = (section++)->disc(value(s.a), ra); break;
    }
  }
}

double TapeSeries::shrinking() const {
  double factor = 1.0;
  const auto within = [&](double radius, double most) {
    if (radius > most) factor = std::min(factor, most / radius);
  };
  const Section* section = sections_.data();
  for (const Tape::Step& s : tape_.steps()) switch (s.operation) {
      case Operation::sine_cosine: within(radius(s.a), widest); break;
      case Operation::exponential: within(radius(s.a), 0.5 * widest); break;
      case Operation::square_root:
        within(radius(s.a), 0.5 * std::abs(series_[static_cast<std::size_t>(s.a)][0]));
        break;
      case Operation::table: {
        const double width = section->high - section->low;
        within(radius(s.a), width);
        ++section;
        break;
      }
      case Operation::divide: within(radius(s.b), 0.5 * std::abs(series_[static_cast<std::size_t>(s.b)][0])); break;
      case Operation::invert: within(radius(s.a), 0.5 * std::abs(series_[static_cast<std::size_t>(s.a)][0])); break;
      case Operation::add:
      case Operation::subtract:
      case Operation::multiply:
      case Operation::shift:
      case Operation::scale: break;
    }
  return factor;
}

/// The n-th section: before the first point, the cubics between the points, behind the last.
void TapeSeries::Section::choose(std::size_t n) {
  number = n;
  const std::vector<double>&points = table->points(), &values = table->values();
  low = n == 0 ? -infinite : points[n - 1];
  high = n == points.size() ? infinite : points[n];
  if (n > 0 && n < points.size())
    cubic = table->cubic(n - 1);
  else
    cubic = {n == 0 ? high : low, 0.0, n == 0 ? values.front() : values.back(), 0.0, 0.0, 0.0};
}

void TapeSeries::Section::find(double x) {
  if (low <= x && x < high) return;
  const std::vector<double>& points = table->points();
  choose(static_cast<std::size_t>(std::upper_bound(points.begin(), points.end(), x) - points.begin()));
}

/// At a point to within what rounding leaves of the time at which it is met: the section that comes next.
void TapeSeries::Section::turn_to(double x, double rate) {
  const double resolution = 1e-12 * std::max(std::abs(x), std::min(high - low, 1.0));
  if (rate > 0.0 && high - x <= resolution) choose(number + 1);
  if (rate < 0.0 && x - low <= resolution) choose(number - 1);
}

double TapeSeries::Section::disc(double x, double radius) const {
  const double s = x - cubic.begin, slope = cubic.slope + s * (2.0 * cubic.second + s * 3.0 * cubic.third);
  const double bend = cubic.second + 3.0 * s * cubic.third;
  return radius * (std::abs(slope) + radius * (std::abs(bend) + radius * std::abs(cubic.third)));
}

}  // namespace wormdrive
