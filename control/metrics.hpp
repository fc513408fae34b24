#pragma once
#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "control/control_record.hpp"
#include "core/field.hpp"
#include "core/mode.hpp"
#include "core/numbers/lanes.hpp"

namespace wormdrive {

/// The part of a run over which metrics are taken [s].
struct MetricsWindow {
  double from{0.0};
  double to{std::numeric_limits<double>::infinity()};

  static constexpr auto fields() {
    using P = MetricsWindow;
    return std::tuple{
        Field{&P::from, "from", unit::second, bounds::not_negative, "start of the window", Presence::optional},
        Field{&P::to, "to", unit::second, bounds::positive, "end of the window; that of the run if not stated",
              Presence::optional}};
  }
  bool operator==(const MetricsWindow&) const = default;
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

/// Whether a metric is one of the tracking error, which there is with a reference only.
inline bool is_of_tracking(double Metrics::*metric) {
  return metric == &Metrics::error_peak_to_peak || metric == &Metrics::error_rms || metric == &Metrics::error_max;
}

/// What metrics need of the samples, of one trial or of several at once.
template <class V>
struct SampleSums {
  V layer;  ///< half width of the boundary layer [rad/s], infinity for a controller without one
  V lowest = std::numeric_limits<double>::infinity(), highest = -std::numeric_limits<double>::infinity();
  V squares = 0.0, torque_squares = 0.0, peak = 0.0, outside = 0.0;

  [[gnu::always_inline]] void add(const ControlRecordOf<V>& record) {
    const V e = record.gear_angle - record.measured.desired.angle;
    lowest = least(lowest, e);
    highest = greatest(highest, e);
    squares += e * e;
    torque_squares += record.applied * record.applied;
    peak = greatest(peak, abs(record.applied));
    const auto out = abs(record.decided.s) > layer;
    if (any(out)) outside = select(out, outside + record.measured.period, outside);
  }
};

/// Takes the metrics while a run goes on; errors are those of the true angle at the samples.
class MetricsMeter {
 public:
  /// layer: half width of the boundary layer [rad/s], infinity for a controller without one.
  MetricsMeter(const MetricsWindow& window, double layer) : window_(window), sums_{.layer = layer} {}

  void sample(const ControlRecord& record) {
    if (!window_.contains(record.measured.t)) return;
    sums_.add(record);
    ++samples_;
  }
  /// Takes the sums of samples that were added up elsewhere, and how many they are.
  void sampled(const SampleSums<double>& sums, long samples) {
    sums_ = sums;
    samples_ = samples;
  }
  const SampleSums<double>& sums() const { return sums_; }

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

  /// Counts flank changes that were seen elsewhere.
  void changed_flank(long times) { flank_changes_ += times; }

  Metrics result() const {
    if (samples_ == 0) {
      Metrics none;
      for_each_field<Metrics>(
          [&](const auto& field) { none.*field.member = std::numeric_limits<double>::quiet_NaN(); });
      return none;
    }
    const double n = static_cast<double>(samples_);
    return {.error_peak_to_peak = sums_.highest - sums_.lowest,
            .error_rms = std::sqrt(sums_.squares / n),
            .error_max = std::max(std::abs(sums_.highest), std::abs(sums_.lowest)),
            .torque_peak = sums_.peak,
            .torque_rms = std::sqrt(sums_.torque_squares / n),
            .reversals = static_cast<double>(reversals_),
            .flank_changes = static_cast<double>(flank_changes_),
            .time_stuck = stuck_,
            .time_outside_layer = sums_.outside};
  }

 private:
  MetricsWindow window_;
  SampleSums<double> sums_;
  double t_ = 0.0, stuck_ = 0.0;
  Mode mode_{};
  long samples_ = 0, reversals_ = 0, flank_changes_ = 0;
};

}  // namespace wormdrive
