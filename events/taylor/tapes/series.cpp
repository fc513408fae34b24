#include "events/taylor/tapes/series.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "events/taylor/tapes/operations.hpp"

namespace wormdrive {

template class TapeSeriesOf<double>;
template void TapeSeriesOf<double>::work_out(int, int, TapeTables&);

bool operator==(const TapeCode& a, const TapeCode& b) {
  const auto same = [](const auto* x, const auto* y, int count) { return std::equal(x, x + count, y); };
  const auto as_numbers = [](const TapeCode& c) {
    return std::array{
        c.operations, c.of_acceleration, c.places,    c.acceleration, c.beyond,      c.worm,         c.gear,
        c.sections,   c.waves,           int{c.lags}, c.states,       c.comparisons, c.exponentials,
    };
  };
  return as_numbers(a) == as_numbers(b) && same(a.arguments, b.arguments, a.sections) &&
         same(a.rates, b.rates, a.states) && same(a.decisions, b.decisions, a.comparisons) &&
         same(a.exponents, b.exponents, a.exponentials) &&
         std::equal(a.steps, a.steps + a.operations, b.steps, [](const Tape::Step& x, const Tape::Step& y) {
           return x.operation == y.operation && x.a == y.a && x.b == y.b && x.result == y.result;
         });
}

TapeTables::TapeTables(const Tape& tape, TapeSeriesOf<double>& series) {
  for (const Tape::Step& s : tape.steps())
    if (s.operation == Tape::Operation::table) {
      places_.push_back({s.table, &series.section(static_cast<int>(places_.size())), 0});
      places_.back().choose(0);
    }
}

void TapeTables::find(int section, double x) {
  Place& place = places_[static_cast<std::size_t>(section)];
  if (place.section->low <= x && x < place.section->high) return;
  const std::vector<double>& points = place.table->points();
  place.choose(static_cast<std::size_t>(std::upper_bound(points.begin(), points.end(), x) - points.begin()));
}

/// At a point to within what rounding leaves of the time at which it is met: the section that comes next.
bool TapeTables::turns(int section, const double* x, int k) {
  if (std::any_of(x + 1, x + k, [](double c) { return c != 0.0; })) return false;
  Place& place = places_[static_cast<std::size_t>(section)];
  const double resolution = resolution_of(*place.section, x[0]);
  const bool rises = x[k] > 0.0 && place.section->high - x[0] <= resolution;
  const bool falls = x[k] < 0.0 && x[0] - place.section->low <= resolution;
  if (rises || falls) place.choose(rises ? place.number + 1 : place.number - 1);
  return rises || falls;
}

void TapeTables::Place::choose(std::size_t n) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  number = n;
  const std::vector<double>&points = table->points(), &values = table->values();
  SectionOf<double>& s = *section;
  s.low = n == 0 ? -infinite : points[n - 1];
  s.high = n == points.size() ? infinite : points[n];
  if (n > 0 && n < points.size()) {
    const CubicTable::Cubic c = table->cubic(n - 1);
    s.begin = c.begin, s.value = c.value, s.slope = c.slope, s.second = c.second, s.third = c.third;
  } else {
    s.begin = n == 0 ? s.high : s.low;
    s.value = n == 0 ? values.front() : values.back();
    s.slope = s.second = s.third = 0.0;
  }
}

}  // namespace wormdrive
