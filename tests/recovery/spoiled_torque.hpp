#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace recovery {

/// A torque that is read at other samples than its own; before the first it stood as there, and after the last.
/// sample(k): which one [-].
template <class Sample>
void reread(std::vector<double>& torque, Sample&& sample) {
  const std::vector<double> was = torque;
  for (std::size_t k = 0; k < torque.size(); ++k)
    torque[k] = was[static_cast<std::size_t>(
        std::clamp(std::floor(sample(static_cast<double>(k)) + 1e-9), 0.0, static_cast<double>(was.size() - 1)))];
}

/// A torque that went through a filter with a time constant of so many samples.
inline void filter(std::vector<double>& torque, double samples) {
  const double keep = std::exp(-1.0 / samples);
  double out = torque.front();
  for (double& u : torque) u = out = keep * out + (1.0 - keep) * u;
}

}  // namespace recovery
