#pragma once
#include <algorithm>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "control/control_record.hpp"
#include "control/disturbance.hpp"
#include "control/encoder_zero.hpp"
#include "control/reference.hpp"
#include "control/sensor.hpp"
#include "control/speed_estimator.hpp"
#include "core/numbers/queue.hpp"
#include "core/numbers/series.hpp"

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
        Field{&P::delay, "delay_samples", unit::whole, bounds::between(0, 1), "computation time in samples, 0 or 1",
              o}};
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
        zero_(sensor.zero_error, sensor.index_mark),
        speed_(sensor.filter_cutoff, sampling.period),
        disturbance_(disturbance, sampling.period),
        exact_speed_(sensor.exact_speed),
        on_worm_(sensor.on_worm),
        plain_(encoder_.is_exact() && !exact_speed_ && !on_worm_ && !zero_.is_off()),
        period_(sampling.period),
        delayed_(sampling.delay > 0.5),
        listener_(std::move(listener)) {}

  /// Takes the angle that a sample will see later.
  template <class System>
  void latch(const System& system, const typename System::Instant& now) {
    latched_.push(seen(system, now));
  }

  /// The motor torque [N m] to command from now on; what disturbs the shaft from now on is put there.
  template <class System>
  double sample(System& system, const typename System::Instant& now) {
    const ReferencePoint desired = reference_.at(now.t);
    const auto at = system.moment(now);
    const bool as_it_is = plain_ && latched_.empty();
    const Seen read = as_it_is ? with_difference(system.measured_angle(now)) : measured(system, now);
    const double limit = system.torque_limit();
    const Measurement m{now.t, read.angle, read.speed, k_ == 0 ? 0.0 : period_, desired, left_, limit};
    const double disturbance = disturbance_(k_++);
    const ControlSignals decided = control_(m);
    const double before = std::exchange(left_, std::clamp(decided.torque, -limit, limit));
    const double applied = delayed_ ? before : left_;
    system.disturb(disturbance);
    listener_(ControlRecord{at.theta_g, m, decided, applied, disturbance});
    return applied;
  }

  /// All that samples change, as numbers: with them a loop of the same settings goes on as this one.
  std::vector<double> memory() const {
    std::vector<double> numbers{static_cast<double>(k_), left_};
    ClosedLoop(*this).visit_memory([&](double number) { numbers.push_back(number); });
    for (const Seen& seen : latched_) numbers.insert(numbers.end(), {seen.angle, seen.speed});
    return numbers;
  }
  /// Takes up such numbers; false where they are none, which leaves the loop in a state of no use.
  bool recall(std::span<const double> numbers) {
    std::size_t fixed = 2;
    visit_memory([&](double) { ++fixed; });
    if (numbers.size() < fixed || (numbers.size() - fixed) % 2 != 0) return false;
    if (!(numbers[0] >= 0.0 && numbers[0] < 0x1p53)) return false;
    k_ = static_cast<std::uint64_t>(numbers[0]);
    left_ = numbers[1];
    std::size_t at = 2;
    visit_memory([&](double& number) { number = numbers[at++]; });
    latched_.clear();
    for (; at < numbers.size(); at += 2) latched_.push({numbers[at], numbers[at + 1]});
    return true;
  }
  /// How many samples were taken, and how many angles for samples to come.
  std::uint64_t samples() const { return k_; }
  std::size_t latched() const { return latched_.size(); }

 private:
  template <class Visit>
  void visit_memory(Visit&& visit) {
    zero_.visit_memory(visit);
    speed_.visit_memory(visit);
    disturbance_.visit_memory(visit);
    control_.visit_memory(visit);
  }

  /// Angle [rad] and speed [rad/s] of the gear, as a sensor sees or shows them.
  struct Seen {
    double angle, speed;
  };
  /// What the sensor sees of the gear, as the worm shows it if it sits there; of the speed only where that is asked
  /// for, out of line, so that what sees none is inline.
  template <class System>
  Seen seen(const System& system, const typename System::Instant& now) const {
    return exact_speed_ || on_worm_ ? seen_with_speed(system, now) : Seen{system.measured_angle(now), 0.0};
  }
  template <class System>
  [[gnu::noinline]] Seen seen_with_speed(const System& system, const typename System::Instant& now) const {
    const auto at = system.moment(now);
    Series<double, 1> angle(on_worm_ ? at.theta_w / system.mesh().i : at.theta_g);
    angle[1] = on_worm_ ? at.omega_w / system.mesh().i : at.omega_g;
    const Series<double, 1> measured = system.effects().measured_angle(angle);
    return {measured[0], measured[1]};
  }

  /// The angle of this sample, and the speed from what it differs by.
  Seen with_difference(double angle) {
    if (k_ == 0) speed_.start(angle);
    return {angle, speed_(angle)};
  }
  /// What the sensor shows where it is late, counts, errs or sits on the worm. Not inline: a controller would wait for
  /// what few sensors do.
  template <class System>
  [[gnu::noinline]] Seen measured(const System& system, const typename System::Instant& now) {
    const Seen shown = latched_.empty() ? seen(system, now) : latched_.front();
    if (!latched_.empty()) latched_.pop();
    const double per = on_worm_ ? system.mesh().i : 1.0;
    Seen read = with_difference(encoder_(per * shown.angle, k_) / per);
    if (exact_speed_) read.speed = shown.speed;
    if (zero_.is_off()) read.angle += zero_(per * read.angle, k_ == 0) / per;  // the speed does not see the zero move
    return read;
  }

  Control control_;
  Reference reference_;
  Encoder encoder_;
  EncoderZero zero_;
  SpeedEstimator speed_;
  TorqueDisturbance disturbance_;
  bool exact_speed_, on_worm_;
  bool plain_;  ///< the sensor shows the gear's angle as it is
  double period_;
  bool delayed_;
  Listener listener_;
  Queue<Seen> latched_;  ///< for the samples to come, where they see what was
  std::uint64_t k_ = 0;
  double left_ = 0.0;  ///< of the torque decided at the sample before, by the limit [N m]
};

}  // namespace wormdrive
