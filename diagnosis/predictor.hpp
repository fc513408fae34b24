#pragma once
#include <algorithm>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "core/worm_drive.hpp"
#include "diagnosis/filtered_states.hpp"
#include "diagnosis/observer_gains.hpp"
#include "diagnosis/prepared_recording.hpp"
#include "events/short_step_solver.hpp"
#include "events/simulate.hpp"

namespace wormdrive {

/// A drive as the predictor follows it: limits and delays are taken out and done on the recorded command, and a late
/// sensor is one more delay of the command, for the state that such a sensor shows is one whose inputs are late.
struct CommandPath {
  double limit;  ///< [N m]
};

/// The effects of a drive for its predictor, and what was taken out.
CommandPath take_out_command_path(Effects<double>& effects);

/// Predicts every sample of a recording from the ones before: the hybrid model runs from sample to sample with the
/// recorded command, exact at events, and the innovation corrects its state.
template <class Load>
class Predictor {
 public:
  using Drive = WormDrive<double, Load>;
  using Instant = typename Drive::Instant;

  /// extra: torque added to the command at every sample [N m], empty for none.
  Predictor(Drive drive, const CommandPath& path, const PreparedRecording& recording, const ObserverGains& gains,
            std::span<const double> extra = {})
      : drive_(std::move(drive)),
        path_(path),
        recording_(recording),
        gains_(gains),
        extra_(extra),
        held_torque_((drive_.mesh().Jw * drive_.mesh().i + drive_.mesh().C(0.0) * drive_.Jg()) /
                     (recording.data.period * recording.data.period)),
        solver_(drive_, std::numeric_limits<double>::infinity()) {}
  Predictor(const Predictor&) = delete;
  Predictor& operator=(const Predictor&) = delete;

  /// Innovations of the gear angle [rad], the first is 0. Throws SolverFault where the model has no motion.
  void operator()(std::span<double> innovations, FilteredStates* states = nullptr) {
    const Recording& data = recording_.data;
    Instant now = start(0, recording_.speed[0]);
    double w = 0.0;
    innovations[0] = 0.0;
    for (std::size_t k = 0;; ++k) {
      if (states) {
        states->angle[k] = now.x[0];
        states->speed[k] = now.x[1];
        states->torque[k] = w;
      }
      if (k + 1 == data.samples()) return;
      run_sample(now, k, w);
      w *= gains_.keep;
      const double e = data.gear_angle[k + 1] - drive_.measured_angle(now);
      innovations[k + 1] = e;
      if (!data.valid.empty() && !data.valid[k + 1])
        innovations[k + 1] = 0.0;
      else
        correct(now, w, k + 1, e);
    }
  }

  /// The angles that the sensor would show at the samples from begin + 1 on, from a state, if these were the
  /// innovations there; without any it is the prediction.
  void run_on(std::size_t begin, double angle, double speed, double w, std::span<const double> innovations,
              std::span<double> angles) {
    rewind(begin);
    Instant now;
    now.t = static_cast<double>(begin) * recording_.data.period;
    now.x = {angle, speed};
    for (std::size_t k = 0; k < angles.size(); ++k) {
      run_sample(now, begin + k, w);
      w *= gains_.keep;
      angles[k] = drive_.measured_angle(now);
      if (innovations.empty()) continue;
      angles[k] += innovations[begin + k + 1];
      correct(now, w, begin + k + 1, innovations[begin + k + 1]);
    }
  }

 private:
  /// More mode changes than this within a sample are no mechanics.
  static constexpr int most_events = 60;

  Instant start(std::size_t k, double speed) {
    rewind(k);
    // the sensor's law is a straight line
    Instant zero, one;
    one.x[0] = 1.0;
    const double offset = drive_.measured_angle(zero), slope = drive_.measured_angle(one) - offset;
    Instant now;
    now.t = static_cast<double>(k) * recording_.data.period;
    now.x = {(recording_.data.gear_angle[k] - offset) / slope, speed / slope};
    return now;
  }
  /// Brings the inputs to a sample; what is on the way then was commanded before it.
  void rewind(std::size_t k) {
    drive_.rewind();
    const double Ts = recording_.data.period;
    const std::size_t memory = std::min<std::size_t>(k, static_cast<std::size_t>(0.1 / Ts));
    drive_.enter(static_cast<double>(k - memory) * Ts);
    for (std::size_t j = k - memory; j < k; ++j) {
      const double t = static_cast<double>(j) * Ts, end = t + Ts;
      drive_.command(t, command(j, 0.0));
      for (double knot = drive_.next_knot(t); knot < end; knot = drive_.next_knot(knot)) drive_.enter(knot);
    }
  }

  /// What an innovation at a sample tells of state and coloured torque.
  void correct(Instant& now, double& w, std::size_t k, double e) const {
    now.x[0] += gains_.angle * e;
    if (!recording_.moving[k] && Drive::at_rest(now.mode)) return;  // data and model agree that it stands
    now.x[1] += gains_.speed * e / recording_.data.period;
    if (recording_.moving[k]) w += gains_.torque * e * held_torque_;
  }

  double command(std::size_t k, double w) const {
    const double u = std::clamp(recording_.data.motor_torque[k], -path_.limit, path_.limit);
    return u + w + (extra_.empty() ? 0.0 : extra_[k]);
  }

  /// From a sample to the next one.
  void run_sample(Instant& now, std::size_t k, double w) {
    const double end = static_cast<double>(k + 1) * recording_.data.period;
    drive_.command(now.t, command(k, w));
    now.mode = drive_.settle(now);
    int events = 0;
    while (true) {
      const double stop = std::min(end, drive_.next_knot(now.t));
      while (!already_there(now.t, stop)) {
        int guard;
        if (Drive::at_rest(now.mode)) {
          now.x[1] = 0.0;
          guard = rest_until(now, stop);
        } else {
          solver_.restart(now);
          guard = solver_.advance(now, stop, stop);
        }
        if (guard == no_guard) break;
        now = drive_.jump(now, guard);
        if (++events > most_events) throw SolverFault("too many events within one sample");
      }
      now.t = stop;
      if (stop == end) return;
      drive_.enter(stop);
      now.mode = drive_.settle(now);
    }
  }

  /// Rests until released. A torque that is held is constant, or approaches what is held as its lag decays: margins
  /// that are positive at both ends are so between, and no search in steps of the lag is needed.
  int rest_until(Instant& now, double stop) {
    Instant then = now;
    then.t = stop;
    const auto holds = [this](const Instant& at) {
      const auto margins = drive_.guards(drive_.moment(at), at.mode);
      return std::all_of(margins.begin(), margins.end(), [](double m) { return m > 0.0; });
    };
    if (drive_.load().fastest() > 0.0 || !holds(now) || !holds(then)) return rest(drive_, now, stop);
    now.t = stop;
    return no_guard;
  }

  Drive drive_;
  CommandPath path_;
  const PreparedRecording& recording_;
  ObserverGains gains_;
  std::span<const double> extra_;
  double held_torque_;  ///< on the worm, of an acceleration by 1 rad per period squared, without friction [N m]
  ShortStepSolver<Drive> solver_;
};

}  // namespace wormdrive
