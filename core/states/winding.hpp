#pragma once
#include <optional>
#include <tuple>

#include "core/effects.hpp"
#include "core/elastic/observation.hpp"

namespace wormdrive {

/// The motor with a winding among the effects, if it is on.
template <class T>
const std::optional<DcMotor<T>>& dc_motor(const Effects<T>& effects) {
  return std::get<std::optional<DcMotor<T>>>(effects.list);
}

/// What the winding of the motor shows for a command [N m].
template <template <class> class M>
std::optional<Winding> winding(const Effects<double>& effects, double command, const M<double>& at) {
  const auto& motor = dc_motor(effects);
  if (!motor) return std::nullopt;
  double current = motor->current(command, at);
  if constexpr (requires { at.states; })
    if (motor->has_states()) current = StateLayout<EffectList<double>>::of<DcMotor<double>>(at.states)[0];
  return Winding{motor->voltage(command), current, motor->resistance * current * current};
}

/// Energy in the field of the winding [J].
inline double stored_energy(const Effects<double>& effects, const std::optional<Winding>& winding) {
  if (!winding) return 0.0;
  return 0.5 * dc_motor(effects)->inductance.value_or(0.0) * winding->current * winding->current;
}

}  // namespace wormdrive
