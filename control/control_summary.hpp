#pragma once
#include <limits>
#include <optional>
#include <variant>

#include "control/controller.hpp"
#include "control/lemma1_monitor.hpp"
#include "control/metrics.hpp"

namespace wormdrive {

/// What a controlled run amounts to.
struct ControlSummary {
  Metrics metrics;
  std::optional<Lemma1Monitor> lemma;  ///< of a sliding controller
  bool follows = true;                 ///< a reference; else there is no tracking error

  bool has(double Metrics::*metric) const { return follows || !is_of_tracking(metric); }
};

/// Half width of a controller's boundary layer [rad/s], infinity for one without.
inline double boundary_layer(const ControllerParameters& law) {
  const auto* const sliding = std::get_if<SlidingParameters>(&law);
  return sliding ? sliding->Phi : std::numeric_limits<double>::infinity();
}

/// What Lemma 1 promises of a controller, to be watched; nothing for another controller than the sliding one.
inline std::optional<Lemma1Monitor> make_monitor(const ControllerParameters& law, const Lemma1& lemma) {
  const auto* const sliding = std::get_if<SlidingParameters>(&law);
  return sliding ? std::optional(Lemma1Monitor(*sliding, lemma)) : std::nullopt;
}

/// Takes what a controlled run amounts to while it goes on.
struct ControlWatch {
  MetricsMeter meter;
  std::optional<Lemma1Monitor> lemma;

  ControlWatch(const MetricsWindow& window, const ControllerParameters& law, const Lemma1& numbers)
      : meter(window, boundary_layer(law)), lemma(make_monitor(law, numbers)) {}

  void sample(const ControlRecord& record) {
    meter.sample(record);
    if (lemma) lemma->sample(record);
  }
  ControlSummary summary() const { return {.metrics = meter.result(), .lemma = lemma}; }
};

}  // namespace wormdrive
