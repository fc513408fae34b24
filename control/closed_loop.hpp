#pragma once
#include <algorithm>
#include <cstdint>
#include <deque>
#include <utility>

#include "control/control_record.hpp"
#include "control/disturbance.hpp"
#include "control/reference.hpp"
#include "control/sensor.hpp"
#include "control/speed_estimator.hpp"

namespace wormdrive {

/// When a controller samples and when its torque arrives.
struct SamplingSettings {
  double period{};     ///< [s]
  double offset{0.0};  ///< of the first sample [s]
  double delay{0.0};   ///< samples between measurement and torque, 0 or 1

  static constexpr auto fields() {
    using P = SamplingSettings;
    constexpr Presence o = Presence::optional;
    return std::tuple{
        Field{&P::period, "sample_time", unit::second, bounds::positive, "time between two samples"},
        Field{&P::offset, "sample_offset", unit::second, bounds::not_negative, "time of the first sample", o},
        Field{&P::delay, "delay_samples", unit::none, bounds::between(0, 1), "computation time in samples, 0 or 1", o}};
  }
  bool operator==(const SamplingSettings&) const = default;
};

/// A sampled controller with its sensor, reference and disturbance: everything between the gear angle and the held
/// motor torque. Control is a callable Measurement -> ControlSignals.
template <class Control, class Listener>
class ClosedLoop {
 public:
  ClosedLoop(Control control, Reference reference, const SensorSettings& sensor, const SamplingSettings& sampling,
             const DisturbanceSettings& disturbance, Listener listener)
      : control_(std::move(control)),
        reference_(std::move(reference)),
        encoder_(sensor),
        speed_(sensor.filter_cutoff, sampling.period),
        disturbance_(disturbance, sampling.period),
        exact_speed_(sensor.exact_speed),
        period_(sampling.period),
        delayed_(sampling.delay > 0.5),
        listener_(std::move(listener)) {}

  /// Takes the angle that a sample will see later.
  template <class System>
  void latch(const System& system, const typename System::Instant& now) {
    latched_.push_back(system.measured_angle(now));
  }

  template <class System>
  double sample(const System& system, const typename System::Instant& now) {
    const ReferencePoint desired = reference_.at(now.t);
    const auto at = system.moment(now);
    const double angle = encoder_(latched_.empty() ? system.measured_angle(now) : latched_.front(), k_);
    if (!latched_.empty()) latched_.pop_front();
    if (k_ == 0) speed_.start(angle);
    const double difference = speed_(angle);
    const Measurement m{now.t, angle, exact_speed_ ? at.omega_g : difference, k_ == 0 ? 0.0 : period_, desired};
    const double disturbance = disturbance_(k_++);
    const ControlSignals decided = control_(m);
    const double torque = delayed_ ? std::exchange(pending_, decided.torque) : decided.torque;
    const double limit = system.torque_limit();
    const double applied = std::clamp(torque + disturbance, -limit, limit);
    listener_(ControlRecord{at.theta_g, m, decided, applied});
    return applied;
  }

 private:
  Control control_;
  Reference reference_;
  Encoder encoder_;
  SpeedEstimator speed_;
  TorqueDisturbance disturbance_;
  bool exact_speed_;
  double period_;
  bool delayed_;
  Listener listener_;
  std::deque<double> latched_;  ///< of the samples to come, where they see an older angle [rad]
  std::uint64_t k_ = 0;
  double pending_ = 0.0;
};

}  // namespace wormdrive
