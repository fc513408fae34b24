#pragma once
#include <array>
#include <cmath>
#include <limits>
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
  if constexpr (requires { at.states; }) {
    auto state = StateLayout<EffectList<double>>::of<DcMotor<double>>(at.states);
    state[0] = motor->current(command, at, state);
    return Winding{motor->voltage(command, at, state), state[0], motor->hot_resistance(state) * state[0] * state[0],
                   state[1]};
  } else {
    const double current = motor->current(command, at);
    return Winding{motor->voltage(command, at), current, motor->resistance * current * current, 0.0};
  }
}

/// Whether the amplifier can give voltage and current of the winding for ever.
inline bool is_within_amplifier(const Effects<double>& effects, const std::optional<Winding>& winding) {
  if (!winding) return true;
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  return std::abs(winding->voltage) <= dc_motor(effects)->supply_voltage.value_or(unlimited) &&
         std::abs(winding->current) <= dc_motor(effects)->current_limit.value_or(unlimited);
}

/// Energy in the field of the winding [J].
inline double stored_energy(const Effects<double>& effects, const std::optional<Winding>& winding) {
  if (!winding) return 0.0;
  return 0.5 * dc_motor(effects)->inductance.value_or(0.0) * winding->current * winding->current;
}

}  // namespace wormdrive
