#pragma once
#include <algorithm>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/moment.hpp"
#include "core/numbers/crossing.hpp"
#include "core/numbers/rounded.hpp"
#include "events/segment_start.hpp"
#include "events/taylor/polynomial_root.hpp"

namespace wormdrive {

/// Watches the quantities of a system at whose zeros its equations bend, as where a stop is met: a solver that steps
/// across one without a look may never see what lies behind it. A bend is a guard that changes no mode: the step ends
/// there, and the motion is taken up anew.
template <class System>
class BendWatch {
 public:
  using Instant = typename System::Instant;
  using Mode = typename System::Mode;

  /// The number of a guard that stands for all bends.
  static constexpr int guard = System::guard_count;

  explicit BendWatch(const System& system) : system_(system), sides_(count(system)) {}
  /// Whether there is nothing to watch.
  bool none() const { return sides_.empty(); }

  /// Begins where a segment starts. On which side of zero each quantity is just after it is found when it is asked for:
  /// a leap across the segment does not.
  void begin(const Instant& now) {
    if (none()) return;
    begin_ = now;
    knows_sides_ = false;
  }
  /// How long [s] the first step may be, infinity mostly: where a segment starts at a bend, rounding may have left it
  /// on the other side, and a series from there has the equations of that side. Asked for once.
  double first_step() {
    know_sides();
    return std::exchange(unsure_, never);
  }

  /// The first bend in [left, right], to which nobody has looked yet; at(x) is where the motion is at x, end that at
  /// right. x runs as time does.
  template <class At>
  std::optional<double> first_between(const At& at, double left, double right, const Instant& end) {
    std::optional<double> first;
    if (none()) return first;
    know_sides();
    const std::vector<Series<double, 1>> there = values(end);
    for (std::size_t k = 0; k < there.size(); ++k) {
      const auto fall = falling_crossing([&](double x) { return values(at(x))[k]; }, left, here_[k], right, there[k]);
      if (fall && (!first || *fall < *first)) first = fall;
    }
    here_ = there;
    return first;
  }

  /// The first bend within h [s] of a motion along which the quantities are power series of an order.
  std::optional<double> first_within(const std::vector<Coefficients>& series, int order, double h, RootSearch& search) {
    know_sides();
    std::optional<double> first;
    for (std::size_t k = 0; k < sides_.size(); ++k) {
      Coefficients c;
      const std::span b(c.data(), static_cast<std::size_t>(order) + 1);
      std::copy_n(series[k].begin(), b.size(), b.begin());
      turn(b, sides_[k]);
      const auto fall = search.first_fall(b, first.value_or(h), true).at;
      if (fall && *fall < h) first = fall;
    }
    return first;
  }
  /// The quantities along a motion by power series.
  template <class M>
  std::vector<Coefficients> along(const M& motion, const Mode& mode) const {
    std::vector<Coefficients> all;
    visit(motion, mode, [&](const auto& b) { all.push_back(b.c); });
    return all;
  }
  /// How long [s] from now on, at a bend, rounding may hide on which side of it the motion is. A series has the
  /// equations of the side that it begins on, so the next one begins behind that.
  double hidden_for(const Instant& now) const {
    double hidden = 0.0;
    if constexpr (Foresees<System>) {
      const double resolution = time_resolution(now.t);
      visit(system_.template ahead<2, Rounded>(now), now.mode, [&](const auto& b) {
        const double unknown = 2.0 * blur(b, 0, resolution), rate = std::abs(b[1].value);
        if (std::abs(b[0].value) <= unknown && rate > 2.0 * blur(b, 1, resolution))
          hidden = std::max(hidden, 2.0 * unknown / rate);
      });
    }
    return hidden;
  }

 private:
  static constexpr double never = std::numeric_limits<double>::infinity();

  /// Which sign a quantity has, and its rounding where it starts at zero.
  struct Side {
    double sign = 1.0, floor = 0.0;
  };

  void know_sides() {
    if (!std::exchange(knows_sides_, true)) find_sides(begin_);
  }
  /// Not inline: few drives have bends, and a segment that is one leap does not ask.
  [[gnu::noinline]] void find_sides(const Instant& now) {
    if constexpr (Foresees<System>) {
      if (find_by_far(now)) return;
      const double resolution = time_resolution(now.t);
      std::size_t k = 0;
      visit(system_.template ahead<4, Rounded>(now), now.mode, [&](const auto& b) {
        const int decides = undecided(b, resolution);
        const bool decided = decides <= b.last;
        // of one that nothing decides, the side to which the series goes that a step would take
        const double sign = (decided ? b[decides].value > 0.0 : goes_up(b)) ? 1.0 : -1.0;
        // one that stays at zero, as the load of a stop that is not met, bends nothing until it leaves it
        const double unknown =
            std::max(2.0 * doubt(b, decided ? decides : 0, resolution), std::numeric_limits<double>::min());
        sides_[k++] = {sign, sign * b[0].value > unknown ? 0.0 : unknown};
      });
      here_ = values(now);
      unsure_ = never;
      for (k = 0; k < sides_.size(); ++k)
        if (sides_[k].floor > 0.0 && here_[k][1] > 0.0)
          unsure_ = std::min(unsure_, 2.0 * sides_[k].floor / here_[k][1]);
    }
  }

  /// The same where value and rate tell all of them from zero, at a fraction of the cost.
  bool find_by_far(const Instant& now) {
    const double resolution = time_resolution(now.t);
    bool far = true;
    here_.clear();
    visit(system_.template ahead<1, Rounded>(now), now.mode, [&](const auto& b) {
      const double size = std::abs(b[0].value), sign = b[0].value > 0.0 ? 1.0 : -1.0;
      far = far && size > std::max(2.0 * blur(b, 0, resolution), std::numeric_limits<double>::min());
      sides_[here_.size()] = {sign, 0.0};
      here_.emplace_back(size);
      here_.back()[1] = sign * b[1].value;
    });
    unsure_ = never;
    return far;
  }

  /// Where the values of a series go, whatever their rounding; up where all are zero.
  template <int N>
  static bool goes_up(const Series<Rounded, N>& b) {
    for (int k = 0; k <= N; ++k)
      if (b[k].value != 0.0) return b[k].value > 0.0;
    return true;
  }
  static std::size_t count(const System& system) {
    if constexpr (requires { system.rigid(); })
      return static_cast<std::size_t>(system.rigid().template bend_count<Moment>());
    else if constexpr (requires { system.template bend_count<System::template MomentHere>(); })
      return static_cast<std::size_t>(system.template bend_count<System::template MomentHere>());
    else
      return 0;
  }
  template <class M, class Use>
  void visit(const M& moment, const Mode& mode, Use&& use) const {
    if constexpr (requires { system_.rigid(); })
      system_.rigid().for_each_bend(moment, mode.gear, use);
    else if constexpr (requires { system_.template bend_count<System::template MomentHere>(); })
      system_.for_each_bend(moment, mode.motion, use);
  }
  /// Lets the coefficients of a quantity be positive where it began.
  template <class C>
  static void turn(C&& coefficients, const Side& side) {
    for (double& c : coefficients) c *= side.sign;
    coefficients[0] += side.floor;
  }
  /// The quantities along a motion, each positive where it began.
  template <class M>
  auto watched(const M& moment, const Mode& mode) const {
    using S = decltype(moment.theta_g);
    std::vector<S> all;
    visit(moment, mode, [&](const S& b) {
      all.push_back(b);
      turn(all.back().c, sides_[all.size() - 1]);
    });
    return all;
  }
  /// The same with their rates.
  std::vector<Series<double, 1>> values(const Instant& now) const {
    if constexpr (Foresees<System>)
      return watched(system_.template ahead<1>(now), now.mode);
    else
      return {};
  }

  const System& system_;
  Instant begin_{};  ///< where the segment starts
  bool knows_sides_ = true;
  std::vector<Side> sides_;
  std::vector<Series<double, 1>> here_;  ///< where the latest look was
  double unsure_ = never;                ///< for so long [s] rounding may hide the side
};

}  // namespace wormdrive
