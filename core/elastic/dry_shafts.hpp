#pragma once
#include "core/torque_balance.hpp"

namespace wormdrive {

/// Whether a torque depends on the direction of the motion, whatever its speed. torque(motion) [N m].
template <class Torque>
bool depends_on_motion(Torque torque) {
  return torque(Motion::forward) != torque(Motion::backward);
}
/// Whether what acts on the worm's shaft does.
template <class T, class Load>
bool worm_is_dry(const TorqueBalance<T, Load>& balance) {
  return depends_on_motion([&](Motion motion) { return balance.effects().worm_torque(turning<T>(), motion); });
}
/// Whether what acts on the gear's shaft does.
template <class T, class Load>
bool gear_is_dry(const TorqueBalance<T, Load>& balance) {
  const auto& effects = balance.effects();
  return depends_on_motion([&](Motion motion) { return effects.gear_torque(T(1), turning<T>(), motion); }) ||
         depends_on_motion([&](Motion motion) { return effects.load_torque(balance.load(), turning<T>(), motion); });
}

}  // namespace wormdrive
