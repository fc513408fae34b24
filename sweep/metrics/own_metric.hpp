#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "core/unit.hpp"
#include "simulation/run_scenario.hpp"
#include "sweep/metrics/course.hpp"

namespace wormdrive {

// What a study may make of a column of its runs. Another one is a struct here, an entry in the variant, its reading and
// its value in own_metric.cpp and read_metrics.cpp.

struct ValueAt {
  static constexpr std::string_view kind = "value";
  double time{};
};
struct Minimum {
  static constexpr std::string_view kind = "minimum";
};
struct Maximum {
  static constexpr std::string_view kind = "maximum";
};
struct PeakToPeak {
  static constexpr std::string_view kind = "peak_to_peak";
};
struct Mean {
  static constexpr std::string_view kind = "mean";
};
struct RootMeanSquare {
  static constexpr std::string_view kind = "rms";
};
struct Integral {
  static constexpr std::string_view kind = "integral";
};
/// What the column is below for a share of the time.
struct TimeQuantile {
  static constexpr std::string_view kind = "quantile";
  double share{};
};
/// When the column crosses a level for the n-th time.
struct CrossingTime {
  static constexpr std::string_view kind = "crossing_time";
  double level{};
  bool rising = true, falling = true;
  int number = 1;
};
/// How long it takes until the column stays within a band about a target, or about its last value.
struct SettlingTime {
  static constexpr std::string_view kind = "settling_time";
  double band{};
  std::optional<double> target;
};

using MetricKind = std::variant<ValueAt, Minimum, Maximum, PeakToPeak, Mean, RootMeanSquare, Integral, TimeQuantile,
                                CrossingTime, SettlingTime>;

/// A metric that a study makes of a column of its runs.
struct OwnMetric {
  std::string name, column;
  bool of_controller = false;  ///< a column of /controller, held from sample to sample; else of /trajectory
  MetricKind kind;
  double from = 0.0, to = 0.0;  ///< the part of the run that counts [s]
  Unit unit{};                  ///< of its value, SI
  std::string meaning{};

  /// Not a number where there is none: of something that never happens.
  double of(const Course& whole) const;
  bool is_time() const {
    return std::holds_alternative<CrossingTime>(kind) || std::holds_alternative<SettlingTime>(kind);
  }
};

/// Takes the values of own metrics while a run goes on. The run must not outlive it.
class OwnMeters {
 public:
  OwnMeters(const std::vector<OwnMetric>& metrics, const Scenario& scenario);
  OwnMeters(const OwnMeters&) = delete;  // listeners refer to it
  OwnMeters& operator=(const OwnMeters&) = delete;

  /// What the run has to tell.
  RunListeners listeners();
  /// The values of all metrics, once the run has ended.
  std::vector<double> values() const;

 private:
  void take(const Trajectory& part);
  void take(const std::vector<ControlRecord>& samples);

  const std::vector<OwnMetric>& metrics_;
  double duration_;
  std::vector<std::function<double(const Row&)>> of_row_;               ///< of each metric; none of the controller's
  std::vector<std::function<double(const ControlRecord&)>> of_sample_;  ///< likewise of the trajectory's
  std::vector<Course> courses_;
  std::vector<Event> events_;  ///< whose row has not come yet
};

}  // namespace wormdrive
