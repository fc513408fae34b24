#include "diagnosis/data/torque_spikes.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/rules/recordings.hpp"
#include "statistics/robust.hpp"

namespace wormdrive {

std::vector<TorqueSpike> torque_spikes(const Recording& recording) {
  const std::vector<double>& u = recording.motor_torque;
  constexpr std::size_t reach = rules::spike_reach;
  if (u.size() <= 2 * reach) return {};
  std::vector<double> instead(u), apart(u.size());
  for (std::size_t k = reach; k + reach < u.size(); ++k) {
    instead[k] = median(
        {u.begin() + static_cast<std::ptrdiff_t>(k - reach), u.begin() + static_cast<std::ptrdiff_t>(k + reach + 1)});
    apart[k] = u[k] - instead[k];
  }
  // As for torques that no motor can have given: noise, however it is distributed, does not come so far. And what is
  // small beside the torques that the drive needs anyway moves it little.
  const double far =
      std::max(rules::impossible_deviations * robust_deviation(apart), rules::least_spike * robust_deviation(u));
  if (far == 0.0) return {};
  std::vector<TorqueSpike> spikes;
  for (std::size_t k = 0; k < u.size(); ++k)
    if (std::abs(apart[k]) > far) spikes.push_back({k, instead[k]});
  if (spikes.size() > u.size() / rules::rarest_spike) spikes.clear();
  return spikes;
}

}  // namespace wormdrive
