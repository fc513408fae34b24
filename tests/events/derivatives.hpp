#pragma once
// Derivatives along a run in three ways: power series of Jets, CVODES, and central differences of whole runs.
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "catch.hpp"
#include "events/sensitivity/sensitivity.hpp"
#include "support.hpp"

namespace wormdrive::test {

/// Events of each kind in a run.
struct Kinds {
  int reversals = 0, captures = 0, releases = 0, flank_changes = 0;

  explicit Kinds(const std::vector<Sensitivities::Event>& events) {
    for (const auto& e : events) {
      const Motion from = e.before.motion, to = e.after.motion;
      ++(from == to ? flank_changes : to == Motion::stuck ? captures : from == Motion::stuck ? releases : reversals);
    }
  }
};

/// Runs that differ in one parameter, compared event by event and row by row.
class Differences {
 public:
  Differences(const RigidDrive& drive, const Timetable& timetable) : drive_(drive), timetable_(timetable) {}

  /// The derivatives by a parameter, of fourth order in the step; the events must be the same ones.
  Sensitivities by(const Parameter& p, double step) const {
    const Sensitivities wide = central(p, step), narrow = central(p, 0.5 * step);
    Sensitivities best = narrow;
    const auto extrapolate = [](auto& to, const auto& coarse) { to = (4.0 * to - coarse) / 3.0; };
    for (std::size_t k = 0; k < best.rows.size(); ++k) {
      extrapolate(best.rows[k].state_by, wide.rows[k].state_by);
      extrapolate(best.rows[k].measured_by, wide.rows[k].measured_by);
    }
    for (std::size_t k = 0; k < best.events.size(); ++k) extrapolate(best.events[k].time_by, wide.events[k].time_by);
    return best;
  }

 private:
  Sensitivities central(Parameter p, double step) const {
    const double at = p.value;
    p.value = at + step;
    const Sensitivities above = sensitivities(changed(drive_, {{p}}), {}, timetable_, tight(taylor, 1e-14));
    p.value = at - step;
    const Sensitivities below = sensitivities(changed(drive_, {{p}}), {}, timetable_, tight(taylor, 1e-14));
    REQUIRE(above.events.size() == below.events.size());
    REQUIRE(above.rows.size() == below.rows.size());
    Sensitivities d = above;
    const auto difference = [&](const auto& a, const auto& b) { return (a - b) / (2.0 * step); };
    for (std::size_t k = 0; k < d.rows.size(); ++k) {
      d.rows[k].state_by = difference(above.rows[k].state, below.rows[k].state);
      d.rows[k].measured_by.setConstant(1, difference(above.rows[k].measured, below.rows[k].measured));
    }
    for (std::size_t k = 0; k < d.events.size(); ++k) {
      REQUIRE(above.events[k].before == below.events[k].before);
      REQUIRE(above.events[k].after == below.events[k].after);
      d.events[k].time_by.setConstant(1, difference(above.events[k].t, below.events[k].t));
    }
    return d;
  }

  const RigidDrive& drive_;
  Timetable timetable_;
};

/// The largest deviation of the derivatives by a parameter, each relative to its largest value along the run: of angle,
/// speed, measured angle and times of events. Rows nearer to an event than `margin` count for nothing.
inline Deviation deviation(const Sensitivities& a, Eigen::Index column, const Sensitivities& b, Eigen::Index other,
                           const std::vector<double>& margin) {
  REQUIRE(a.rows.size() == b.rows.size());
  REQUIRE(a.events.size() == b.events.size());
  Deviation worst;
  // what would move a quantity by a share of 1e-10 of its size, as the parameter doubles, is an error of the solver
  const double value = std::abs(a.parameters[static_cast<std::size_t>(column)].value);
  const auto rounding = [&](double size) { return 1e-10 * size / (value > 0.0 ? value : 1.0); };
  const auto compare = [&](std::size_t count, double size, auto&& left, auto&& right, auto&& counts) {
    double largest = 0.0;
    Deviation found;
    for (std::size_t k = 0; k < count; ++k) {
      largest = std::max(largest, std::abs(left(k)));
      if (counts(k)) found.add(left(k) - right(k));
    }
    const double error = found.size <= rounding(size) ? 0.0 : found.size;
    // a derivative that is zero all along is zero in every way of finding it
    worst.add(largest > rounding(size) ? error / largest : error > 1e-9 ? 1.0 : 0.0);
  };
  const auto clear = [&](std::size_t row) {
    for (std::size_t e = 0; e < a.events.size(); ++e)
      if (std::abs(a.events[e].t - a.rows[row].t) <= margin[e]) return false;
    return true;
  };
  const auto compare_rows = [&](auto&& value_at, auto&& by) {
    double size = 0.0;
    for (const auto& row : a.rows) size = std::max(size, std::abs(value_at(row)));
    compare(
        a.rows.size(), size, [&](std::size_t k) { return by(a.rows[k], column); },
        [&](std::size_t k) { return by(b.rows[k], other); }, clear);
  };
  using Row = Sensitivities::Row;
  for (Eigen::Index n = 0; n < a.rows.front().state.size(); ++n)
    compare_rows([n](const Row& row) { return row.state[n]; },
                 [n](const Row& row, Eigen::Index c) { return row.state_by(n, c); });
  compare_rows([](const Row& row) { return row.measured; },
               [](const Row& row, Eigen::Index c) { return row.measured_by[c]; });
  compare(
      a.events.size(), a.rows.back().t, [&](std::size_t k) { return a.events[k].time_by[column]; },
      [&](std::size_t k) { return b.events[k].time_by[other]; }, [](std::size_t) { return true; });
  return worst;
}

/// The step of a parameter by which the state changes by at most `change`, and the parameter by a hundredth.
inline double step_for(const Sensitivities& s, Eigen::Index column, double change) {
  double largest = 0.0;
  for (const auto& row : s.rows)
    largest = std::max({largest, std::abs(row.state_by(0, column)), std::abs(row.state_by(1, column)),
                        std::abs(row.measured_by[column])});
  const double value = std::abs(s.parameters[static_cast<std::size_t>(column)].value);
  return value > 0.0 ? std::min(change / largest, 0.01 * value) : change / largest;
}

/// What three ways of finding the derivatives by the parameters of a table differ by.
struct Agreement {
  Sensitivities series;
  Deviation cvodes, differences;
};

inline Agreement agreement(const RigidDrive& drive, const std::vector<Parameter>& by, const Timetable& timetable,
                           double change = 5e-5) {
  Agreement found{sensitivities(drive, by, timetable, tight(taylor, 1e-12)), {}, {}};
  const Sensitivities& series = found.series;
  const Sensitivities cvodes = sensitivities(drive, by, timetable, tight(adams, 1e-12));
  for (std::size_t k = 0; k < by.size(); ++k) {
    const auto column = static_cast<Eigen::Index>(k);
    INFO(by[k].table << "." << by[k].field);
    const double step = step_for(series, column, change);
    REQUIRE(std::isfinite(step));
    std::vector<double> none(series.events.size(), 0.0), passed;
    for (const auto& e : series.events) passed.push_back(2.0 * step * std::abs(e.time_by[column]) + 1e-12);
    const Deviation c = deviation(series, column, cvodes, column, none);
    const Deviation d = deviation(series, column, Differences(drive, timetable).by(by[k], step), 0, passed);
    found.cvodes.add(c.size);
    found.differences.add(d.size);
    CAPTURE(c, d, step);
    CHECK(c <= 1e-6);
    CHECK(d <= 1e-6);
  }
  return found;
}

}  // namespace wormdrive::test
