#include "diagnosis/data/torque_spikes.hpp"

#include <algorithm>
#include <cmath>

#include "statistics/robust.hpp"

namespace wormdrive {

std::vector<TorqueSpike> torque_spikes(const Recording& recording) {
  const std::vector<double>& u = recording.motor_torque;
  constexpr std::size_t reach = 3;  // seven samples have a median that three do not move
  if (u.size() <= 2 * reach) return {};
  std::vector<double> instead(u), apart(u.size());
  for (std::size_t k = reach; k + reach < u.size(); ++k) {
    instead[k] = median(
        {u.begin() + static_cast<std::ptrdiff_t>(k - reach), u.begin() + static_cast<std::ptrdiff_t>(k + reach + 1)});
    apart[k] = u[k] - instead[k];
  }
  // As for torques that no motor can have given: noise, however it is distributed, does not come so far. And what is
  // small beside the torques that the drive needs anyway moves it little.
  constexpr double robust_deviations = 20.0, least_share = 0.5;
  const double far = std::max(robust_deviations * robust_deviation(apart), least_share * robust_deviation(u));
  if (far == 0.0) return {};
  std::vector<TorqueSpike> spikes;
  for (std::size_t k = 0; k < u.size(); ++k)
    if (std::abs(apart[k]) > far) spikes.push_back({k, instead[k]});
  constexpr std::size_t one_in = 100;
  if (spikes.size() > u.size() / one_in) spikes.clear();
  return spikes;
}

}  // namespace wormdrive
