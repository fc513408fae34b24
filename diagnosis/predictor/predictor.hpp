#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "core/effects.hpp"
#include "diagnosis/data/prepared_recording.hpp"
#include "diagnosis/predictor/filtered_states.hpp"
#include "diagnosis/predictor/flight.hpp"
#include "diagnosis/predictor/observer_gains.hpp"
#include "diagnosis/rules/noise.hpp"
#include "events/simulation_failure.hpp"

namespace wormdrive {

/// A drive as the predictor follows it: limits and delays are taken out and done on the recorded command, and a late
/// sensor is one more delay of the command, for the state that such a sensor shows is one whose inputs are late. The
/// gap between the teeth and their compliance are taken out of a drive whose teeth are rigid.
struct TakenOut {
  double limit;       ///< [N m]
  double gap;         ///< [rad]
  double compliance;  ///< [m/N]
};

/// The effects of a drive for its predictor, and what was taken out.
TakenOut take_out(Effects<double>& effects);

/// Predicts every sample of a recording from the ones before: the hybrid model runs from sample to sample with the
/// recorded command, exact at events, and the innovation corrects its state. Model: a drive as it is followed from
/// sample to sample.
template <class Model>
class Predictor {
 public:
  using Drive = typename Model::Drive;
  using State = typename Model::State;

  /// extra: torque added to the command at every sample [N m], empty for none.
  Predictor(Drive drive, const TakenOut& out, const Restitution& impact, const PreparedRecording& recording,
            const std::vector<ObserverGains>& gains, std::span<const double> extra = {})
      : model_(std::move(drive), out.gap, recording.worm_angle.empty() ? 0.0 : out.compliance, impact),
        out_(out),
        recording_(recording),
        gains_(gains),
        extra_(extra),
        held_torque_(
            (model_.drive().mesh().Jw * model_.drive().mesh().i + model_.drive().mesh().C(0.0) * model_.drive().Jg()) /
            (recording.data.period * recording.data.period)) {}

  /// Innovations of the gear angle and, with an encoder on it, of the worm counted at the gear [rad]; the first are 0.
  /// The worm's correct the state, and the gear's are those that are left then. Throws SolverFault where the model has
  /// no motion, or loses the measured one.
  void operator()(std::span<double> of_gear, std::span<double> of_worm, FilteredStates* states = nullptr) {
    const Recording& data = recording_.data;
    State now = start(0);
    double w = 0.0;
    std::size_t end = recording_.end_of_stretch(0);
    if (states && has_states) states->of_effects.resize(data.samples());
    for (std::size_t k = 0;; ++k) {
      if (states) keep(*states, k, now, w);
      if (k + 1 == data.samples()) break;
      if (k + 1 == end) {  // nobody knows what happens in the pause
        const State before = std::exchange(now, start(end));
        if constexpr (has_states) now.now.x.tail(effect_state_count) = before.now.x.tail(effect_state_count);
        w = 0.0;
        end = recording_.end_of_stretch(end);
        continue;
      }
      run_sample(now, k, w);
      w *= gains(k + 1).keep;
      if (!data.valid.empty() && !data.valid[k + 1]) continue;
      if (!of_worm.empty()) {
        of_worm[k + 1] = recording_.worm_angle[k + 1] - model_.worm(now).angle;
        correct(now, w, k + 1, of_worm[k + 1]);
      }
      of_gear[k + 1] = data.gear_angle[k + 1] - model_.measured_angle(now);
      if (!(std::abs(of_gear[k + 1]) < rules::lost)) throw SolverFault("the prediction has left the motion");
      if (of_worm.empty()) correct(now, w, k + 1, of_gear[k + 1]);
    }
    if (!of_worm.empty()) align(of_gear);
  }

  /// The angles that the sensor would show at the samples from begin + 1 on, from a state, if these were the
  /// innovations there; without any it is the prediction.
  void run_on(std::size_t begin, const FilteredStates& from, std::span<const double> of_gear,
              std::span<const double> of_worm, std::span<double> angles) {
    rewind(begin);
    double w = from.torque[begin];
    State now = model_.at(time(begin), {from.angle[begin], from.speed[begin]},
                          {from.worm_angle[begin], from.worm_speed[begin]});
    if constexpr (has_states) std::ranges::copy(from.of_effects[begin], now.now.x.data() + 2);
    for (std::size_t k = 0; k < angles.size(); ++k) {
      run_sample(now, begin + k, w);
      w *= gains(begin + k + 1).keep;
      if (!of_worm.empty()) correct(now, w, begin + k + 1, of_worm[begin + k + 1]);
      angles[k] = model_.measured_angle(now);
      if (of_gear.empty()) continue;
      angles[k] += of_gear[begin + k + 1];
      if (of_worm.empty()) correct(now, w, begin + k + 1, of_gear[begin + k + 1]);
    }
  }

 private:
  static constexpr bool has_states = Drive::state_size > 2;

  double time(std::size_t k) const { return recording_.data.time(k); }

  const ObserverGains& gains(std::size_t k) const { return gains_at(gains_, k); }

  /// What a sample that none before tells of shows of the state.
  State start(std::size_t k) {
    rewind(k);
    drive().command(time(k), command(k, 0.0));
    // the sensor's law is a straight line
    const double offset = drive().effects().measured_angle(0.0), slope = drive().effects().measured_angle(1.0) - offset;
    return model_.at(time(k), {(recording_.data.gear_angle[k] - offset) / slope, recording_.speed[k] / slope});
  }
  void keep(FilteredStates& states, std::size_t k, const State& now, double w) const {
    const ShaftState worm = model_.worm(now);
    states.angle[k] = now.now.x[0];
    states.speed[k] = now.now.x[1];
    states.torque[k] = w;
    states.worm_angle[k] = worm.angle;
    states.worm_speed[k] = worm.speed;
    if constexpr (has_states) std::copy_n(now.now.x.data() + 2, effect_state_count, states.of_effects[k].begin());
  }
  /// Brings the inputs to a sample; what is on the way then was commanded before it.
  void rewind(std::size_t k) {
    drive().rewind();
    const std::size_t memory =
        std::min<std::size_t>(k, static_cast<std::size_t>(rules::remembered_time / recording_.data.period));
    drive().enter(time(k - memory));
    for (std::size_t j = k - memory; j < k; ++j) {
      const double t = time(j), end = time(j + 1);
      drive().command(t, command(j, 0.0));
      for (double knot = drive().next_knot(t); knot < end; knot = drive().next_knot(knot)) drive().enter(knot);
    }
  }

  /// What an innovation at a sample tells of state and coloured torque.
  void correct(State& now, double& w, std::size_t k, double e) const {
    // where data and model agree that it stands it does not get a speed
    const bool stands = !recording_.moving[k] && model_.at_rest(now);
    model_.shift(now, gains(k).angle * e, stands ? 0.0 : gains(k).speed * e / recording_.data.period);
    if (recording_.moving[k]) w += gains(k).torque * e * held_torque_;
  }

  /// Takes out of the gear's innovations what a wrong zero of the worm has put there.
  void align(std::span<double> of_gear) const {
    std::vector<double> seen;
    for (std::size_t k = 0; k < of_gear.size(); ++k)
      if (recording_.used[k] && !recording_.held_out[k]) seen.push_back(of_gear[k]);
    if (seen.empty()) return;
    const auto middle = seen.begin() + static_cast<std::ptrdiff_t>(seen.size() / 2);
    std::nth_element(seen.begin(), middle, seen.end());
    for (std::size_t k = 1; k < of_gear.size(); ++k)
      if (recording_.used[k]) of_gear[k] -= *middle;
  }

  double command(std::size_t k, double w) const {
    const double u = std::clamp(recording_.data.motor_torque[k], -out_.limit, out_.limit);
    return u + w + (extra_.empty() ? 0.0 : extra_[k]);
  }

  /// From a sample to the next one.
  void run_sample(State& now, std::size_t k, double w) {
    drive().command(now.now.t, command(k, w));
    model_.run(now, time(k + 1));
  }

  Drive& drive() { return model_.drive(); }

  Model model_;
  TakenOut out_;
  const PreparedRecording& recording_;
  const std::vector<ObserverGains>& gains_;  ///< of every sample, or one for all
  std::span<const double> extra_;
  double held_torque_;  ///< on the worm, of an acceleration by 1 rad per period squared, without friction [N m]
};

}  // namespace wormdrive
