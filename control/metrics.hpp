#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "control/closed_loop.hpp"
#include "core/field.hpp"
#include "core/mode.hpp"

namespace wormdrive {

/// The part of a run over which metrics are taken [s].
struct MetricsWindow {
  double from{0.0};
  double to{std::numeric_limits<double>::infinity()};

  static constexpr auto fields() {
    using P = MetricsWindow;
    return std::tuple{
        Field{&P::from, "from", unit::second, bounds::not_negative, "begin of the window", Presence::optional},
        Field{&P::to, "to", unit::second, bounds::positive, "end of the window; that of the run if not stated",
              Presence::optional}};
  }
  bool contains(double t) const { return t >= from && t <= to; }
};

/// How well a controlled run went, over its window.
struct Metrics {
  double error_peak_to_peak{0.0}, error_rms{0.0}, error_max{0.0};
  double torque_peak{0.0}, torque_rms{0.0};
  double reversals{0.0}, flank_changes{0.0};
  double time_stuck{0.0}, time_outside_layer{0.0};

  static constexpr auto fields() {
    using P = Metrics;
    return std::tuple{
        Field{&P::error_peak_to_peak, "error_peak_to_peak", unit::radian, bounds::any,
              "tracking error, largest minus smallest"},
        Field{&P::error_rms, "error_rms", unit::radian, bounds::any, "tracking error, root mean square"},
        Field{&P::error_max, "error_max", unit::radian, bounds::any, "tracking error, largest magnitude"},
        Field{&P::torque_peak, "torque_peak", unit::newton_metre, bounds::any, "motor torque, largest magnitude"},
        Field{&P::torque_rms, "torque_rms", unit::newton_metre, bounds::any, "motor torque, root mean square"},
        Field{&P::reversals, "reversals", unit::none, bounds::any, "reversals"},
        Field{&P::flank_changes, "flank_changes", unit::none, bounds::any, "flank changes"},
        Field{&P::time_stuck, "time_stuck", unit::second, bounds::any, "time in stick"},
        Field{&P::time_outside_layer, "time_outside_layer", unit::second, bounds::any,
              "time with the sliding variable outside its layer"}};
  }
};

/// Takes the metrics while a run goes on; errors are those of the true angle at the samples.
class MetricsMeter {
 public:
  /// layer: half width of the boundary layer [rad/s], infinity for a controller without one.
  MetricsMeter(const MetricsWindow& window, double layer) : window_(window), layer_(layer) {}

  void sample(const ControlRecord& record) {
    const double t = record.measured.t;
    if (!window_.contains(t)) return;
    const double e = record.gear_angle - record.measured.desired.angle;
    lowest_ = std::min(lowest_, e);
    highest_ = std::max(highest_, e);
    squares_ += e * e;
    torque_squares_ += record.applied * record.applied;
    peak_ = std::max(peak_, std::abs(record.applied));
    if (std::abs(record.decided.s) > layer_) outside_ += record.measured.period;
    ++samples_;
  }

  /// Takes an instant of the run, both sides of events included.
  void instant(double t, Mode mode) {
    if (window_.contains(t)) {
      if (!(mode == mode_) && t == t_ && mode.motion != Motion::stuck && mode_.motion != Motion::stuck)
        ++(mode.motion == mode_.motion ? flank_changes_ : reversals_);
      if (mode_.motion == Motion::stuck) stuck_ += t - std::max(t_, window_.from);
    }
    t_ = t;
    mode_ = mode;
  }

  Metrics result() const {
    if (samples_ == 0) {
      constexpr double none = std::numeric_limits<double>::quiet_NaN();
      return {none, none, none, none, none, none, none, none, none};
    }
    const double n = static_cast<double>(samples_);
    return {highest_ - lowest_,
            std::sqrt(squares_ / n),
            std::max(std::abs(highest_), std::abs(lowest_)),
            peak_,
            std::sqrt(torque_squares_ / n),
            static_cast<double>(reversals_),
            static_cast<double>(flank_changes_),
            stuck_,
            outside_};
  }

 private:
  MetricsWindow window_;
  double layer_;
  double lowest_ = std::numeric_limits<double>::infinity(), highest_ = -lowest_;
  double squares_ = 0.0, torque_squares_ = 0.0, peak_ = 0.0, stuck_ = 0.0, outside_ = 0.0;
  double t_ = 0.0;
  Mode mode_{};
  long samples_ = 0, reversals_ = 0, flank_changes_ = 0;
};

}  // namespace wormdrive
