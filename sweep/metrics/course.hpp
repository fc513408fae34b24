#pragma once
#include <vector>

namespace wormdrive {

/// A quantity over time: straight lines between points, a jump where two points have the same time.
struct Course {
  struct Point {
    double t, y;  ///< [s]; in the unit of the quantity
  };
  std::vector<Point> points;

  bool empty() const { return points.empty(); }
  double begin() const { return points.front().t; }
  double duration() const { return points.back().t - points.front().t; }

  /// The part from a time to another one [s], from behind a jump to before one; none if these are not within it.
  Course between(double from, double to) const;

  double at(double t) const;  ///< behind a jump, if there is one
  double least() const;
  double greatest() const;
  double mean() const;
  double root_mean_square() const;
  double integral() const;
  /// What it is below for a share of the time.
  double quantile(double share) const;
  /// When it crosses a level for the n-th time, n >= 1, in the directions that count; not a number if it does not.
  double crossing(double level, bool rising, bool falling, int n) const;
  /// From its begin until it stays within a band about a target [s]; not a number if it ends outside.
  double settling(double target, double band) const;
};

}  // namespace wormdrive
