#include "diagnosis/verdict/residual_torque.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "diagnosis/data/moved_load.hpp"
#include "diagnosis/rules/verdict.hpp"

namespace wormdrive {

namespace {

/// Residual torques of every sample of one recording after the other [N m].
std::vector<std::vector<double>> torques(const Evaluation& evaluation, const Hypothesis& h) {
  std::vector<FilteredStates> states;
  const bool goes_on = evaluation.innovations(extended(h), h.noise, {}, &states).has_value();
  std::vector<std::vector<double>> all;
  for (std::size_t recording = 0; recording < evaluation.layout().recordings.size(); ++recording) {
    const PreparedRecording& r = evaluation.layout().recordings[recording];
    const std::vector<ObserverGains> gains = observer_gains(h.noise, r);
    const double per_speed = inertia_on_worm(evaluation, h, recording) / (r.data.period * r.data.period);
    std::vector<double>& torque = all.emplace_back(r.samples(), 0.0);
    for (std::size_t k = 0; goes_on && k < torque.size(); ++k) {
      const std::size_t q = evaluation.layout().leading(recording).begin + k;
      const double limit = rules::clip_of_torque * h.noise_model.groups[evaluation.layout().group[q]].scale;
      const double e = std::clamp(h.innovations[q], -limit, limit);
      torque[k] = per_speed * gains_at(gains, k).speed * e + states[recording].torque[k];
    }
  }
  return all;
}

}  // namespace

ResidualTorque residual_torque(const Evaluation& evaluation, const Hypothesis& before, const Hypothesis& after) {
  ResidualTorque map;
  const std::vector<std::vector<double>> all_then = torques(evaluation, before), all_now = torques(evaluation, after);
  for (std::size_t r = 0; r < evaluation.layout().recordings.size(); ++r) {
    const PreparedRecording& recording = evaluation.layout().recordings[r];
    const std::vector<double>&then = all_then[r], &now = all_now[r];
    const auto bin = static_cast<std::size_t>(std::max(1L, std::lround(rules::torque_bin / recording.data.period)));
    const auto drive = loaded_drive(evaluation.scenario(), recording.data);
    auto load = drive.load();
    for (std::size_t begin = 0; begin + bin <= recording.samples(); begin += bin) {
      double sum_then = 0.0, sum_now = 0.0;
      bool whole = true;
      for (std::size_t k = begin; k < begin + bin; ++k) {
        whole = whole && recording.moving[k] && recording.used[k];
        sum_then += then[k];
        sum_now += now[k];
      }
      if (!whole) continue;
      const std::size_t middle = begin + bin / 2;
      const double t = recording.data.time(middle);
      const double angle = recording.data.gear_angle[middle];
      load.enter(t);
      const Moment<double> at = drive.moment(t, angle, recording.speed[middle]);
      const double turn = 2.0 * std::numbers::pi;
      map.time.push_back(recording.data.start + t);
      map.gear_angle.push_back(angle);
      map.gear_speed.push_back(recording.speed[middle]);
      map.load_torque.push_back(load.torque(at));
      map.worm_phase.push_back(at.theta_w - turn * std::floor(at.theta_w / turn));
      map.before.push_back(sum_then / static_cast<double>(bin));
      map.after.push_back(sum_now / static_cast<double>(bin));
      map.held_out.push_back(recording.held_out[middle]);
    }
  }
  return map;
}

}  // namespace wormdrive
