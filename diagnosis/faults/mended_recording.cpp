#include "diagnosis/faults/mended_recording.hpp"

#include <algorithm>
#include <cmath>

namespace wormdrive {

namespace {

void mend_spikes(PreparedRecording& r, const TorqueSpikes& fault) {
  for (const TorqueSpike& spike : r.torque_spikes) {
    double& torque = r.data.motor_torque[spike.sample];
    torque += fault.share * (spike.instead - torque);
  }
}

/// What went into a filter of first order whose output is known: r_k = a r_(k-1) + (1 - a) u_k.
void undo_filter(PreparedRecording& r, const FilteredTorque& fault) {
  if (fault.time_constant <= 0.0) return;
  std::vector<double>& u = r.data.motor_torque;
  for (std::size_t begin = 0; begin < r.samples(); begin = r.end_of_stretch(begin)) {
    double before = u[begin];
    for (std::size_t k = begin + 1; k < r.end_of_stretch(begin); ++k) {
      const double a = std::exp(-(r.data.time(k) - r.data.time(k - 1)) / fault.time_constant);
      const double now = u[k];
      u[k] = (now - a * before) / (1.0 - a);
      before = now;
    }
  }
}

/// Brings the torque forward by time + share t. What is held from sample to sample then changes within one: its mean
/// there stands for it, which moves the gear alike but for the share of a sample in which it does.
void bring_forward(PreparedRecording& r, double time, double share) {
  const std::vector<double> was = r.data.motor_torque;
  for (std::size_t begin = 0; begin < r.samples(); begin = r.end_of_stretch(begin)) {
    const auto first = static_cast<double>(begin), last = static_cast<double>(r.end_of_stretch(begin) - 1);
    for (std::size_t k = begin; k < r.end_of_stretch(begin); ++k) {
      const double from = static_cast<double>(k) + (time + share * r.data.time(k)) / r.data.period;
      const double whole = std::floor(from);
      const auto held = [&](double sample) { return was[static_cast<std::size_t>(std::clamp(sample, first, last))]; };
      r.data.motor_torque[k] = held(whole) + (from - whole) * (held(whole + 1.0) - held(whole));
    }
  }
}

void count_seconds(PreparedRecording& r, const TimeScale& fault) {
  const double scale = 1.0 / (1.0 + fault.share);
  r.data.period *= scale;
  for (double& t : r.data.times) t *= scale;
  for (double& v : r.speed) v /= scale;
  r.rms_speed /= scale;
}

}  // namespace

PreparedRecording mended(PreparedRecording r, const RecordingFaults& faults) {
  if (const auto& spikes = faults.of<TorqueSpikes>()) mend_spikes(r, *spikes);
  if (const auto& filter = faults.of<FilteredTorque>()) undo_filter(r, *filter);
  const auto& late = faults.of<LateTorque>();
  const auto& drift = faults.of<ClockDrift>();
  if (late || drift) bring_forward(r, late ? late->time : 0.0, drift ? drift->share : 0.0);
  if (const auto& scale = faults.of<TimeScale>()) count_seconds(r, *scale);
  return r;
}

}  // namespace wormdrive
