#pragma once
#include <vector>

#include "diagnosis/data/prepared_recording.hpp"
#include "diagnosis/predictor/restitution.hpp"

namespace wormdrive {

/// What no effect states and every fit finds for itself: how strongly a drive is disturbed, against the noise of its
/// sensor, as standard deviations of what it does to the angle within one sample in units of the sensor's noise; and
/// how teeth bounce.
struct ProcessNoise {
  double white = 0.005;     ///< torque that is new at every sample
  double coloured = 0.003;  ///< torque that lasts
  Restitution impact{};
  double period = 0.0;  ///< of the samples for which these are stated [s]; 0: of any

  bool has_torques_of(const ProcessNoise& other) const {
    return white == other.white && coloured == other.coloured && period == other.period;
  }
  /// The same torques, by what they do within samples of another period.
  ProcessNoise over(double other) const;
};

/// What an innovation of the angle adds to the state; in floats, for hours of samples may have one each.
struct ObserverGains {
  float angle{};   ///< per innovation
  float speed{};   ///< per innovation and period
  float torque{};  ///< as acceleration, per innovation and period squared; only while moving
  float keep{};    ///< share of the coloured torque that is left after one period

  ObserverGains() = default;
  ObserverGains(double to_angle, double to_speed, double to_torque, double kept)
      : angle(static_cast<float>(to_angle)),
        speed(static_cast<float>(to_speed)),
        torque(static_cast<float>(to_torque)),
        keep(static_cast<float>(kept)) {}
};

/// Gains of the steady Kalman filter for a double integrator that is driven by white and coloured noise and whose angle
/// is measured [Kalman 1960]; the states are scaled to the sensor's noise and to the period [s].
ObserverGains observer_gains(const ProcessNoise& noise, double period);

/// The gains for every sample of a recording whose steps are uneven, of which samples are missing or whose readings
/// count by shares, by the same filter while it is not steady; a single one where all would be alike. Where nothing is
/// measured they are 0. A reading that counts by a share is as if its noise had the variance of one divided by it.
std::vector<ObserverGains> observer_gains(const ProcessNoise& noise, const PreparedRecording& recording);

/// The gains at a sample.
inline const ObserverGains& gains_at(const std::vector<ObserverGains>& gains, std::size_t k) {
  return gains.size() == 1 ? gains.front() : gains[k];
}

}  // namespace wormdrive
