#pragma once
#include <cmath>
#include <cstdint>
#include <tuple>

#include "core/field.hpp"
#include "core/numbers/portable.hpp"
#include "statistics/random.hpp"

namespace wormdrive {

/// A random torque on the worm's shaft, held between samples: white, or coloured by a first-order filter. It acts
/// beside the motor: no limit, gain, delay or lag of the actuator touches it.
struct DisturbanceSettings {
  double deviation{0.0};      ///< standard deviation [N m]; 0: none
  double time_constant{0.0};  ///< of the colouring [s]; 0: white
  double seed{1};

  static constexpr auto fields() {
    using P = DisturbanceSettings;
    constexpr Presence o = Presence::optional;
    return std::tuple{
        Field{&P::deviation, "deviation", unit::newton_metre, bounds::not_negative, "standard deviation"},
        Field{&P::time_constant, "time_constant", unit::second, bounds::not_negative, "colouring; 0 is white", o},
        Field{&P::seed, "seed", unit::whole, seeds, "seed of the random torque", o}};
  }
};

class TorqueDisturbance {
 public:
  TorqueDisturbance(const DisturbanceSettings& settings, double period)
      : settings_(settings),
        keep_(settings.time_constant > 0.0 ? portable::exp(-period / settings.time_constant) : 0.0),
        renew_(std::sqrt(1.0 - keep_ * keep_)) {}

  /// The torque [N m] from the k-th sample on; its variance is the same from the first sample.
  double operator()(std::uint64_t k) {
    if (settings_.deviation <= 0.0) return 0.0;
    const double fresh = normal(static_cast<std::uint64_t>(settings_.seed), Stream::torque_disturbance, k);
    state_ = k == 0 ? fresh : keep_ * state_ + renew_ * fresh;
    return settings_.deviation * state_;
  }
  /// Calls visit(number) for every number that samples change.
  template <class Visit>
  void visit_memory(Visit&& visit) {
    visit(state_);
  }

 private:
  DisturbanceSettings settings_;
  double keep_, renew_, state_ = 0.0;
};

}  // namespace wormdrive
