#pragma once
#include <array>
#include <optional>
#include <tuple>

#include "core/effects/actuator_delay.hpp"
#include "core/effects/actuator_lag.hpp"
#include "core/effects/agma.hpp"
#include "core/effects/backlash.hpp"
#include "core/effects/bearing_asymmetry.hpp"
#include "core/effects/cogging.hpp"
#include "core/effects/dc_motor.hpp"
#include "core/effects/encoder_delay.hpp"
#include "core/effects/encoder_offset.hpp"
#include "core/effects/encoder_scale.hpp"
#include "core/effects/friction_asymmetry.hpp"
#include "core/effects/friction_drift.hpp"
#include "core/effects/friction_map.hpp"
#include "core/effects/friction_under_load.hpp"
#include "core/effects/gear_coulomb.hpp"
#include "core/effects/gear_inertia.hpp"
#include "core/effects/gear_viscous.hpp"
#include "core/effects/gearbox_heat.hpp"
#include "core/effects/hard_stops.hpp"
#include "core/effects/holding_brake.hpp"
#include "core/effects/load_angle.hpp"
#include "core/effects/load_coupling.hpp"
#include "core/effects/load_crank.hpp"
#include "core/effects/load_four_bar.hpp"
#include "core/effects/load_magnitude.hpp"
#include "core/effects/load_map.hpp"
#include "core/effects/load_spring.hpp"
#include "core/effects/mesh_friction.hpp"
#include "core/effects/mesh_lugre.hpp"
#include "core/effects/position_friction.hpp"
#include "core/effects/static_friction.hpp"
#include "core/effects/stribeck.hpp"
#include "core/effects/thread_friction.hpp"
#include "core/effects/tooth_compliance.hpp"
#include "core/effects/torque_gain.hpp"
#include "core/effects/torque_map.hpp"
#include "core/effects/torque_offset.hpp"
#include "core/effects/torque_saturation.hpp"
#include "core/effects/transmission_error.hpp"
#include "core/effects/vibration.hpp"
#include "core/effects/worm_coulomb.hpp"
#include "core/effects/worm_inertia.hpp"
#include "core/effects/worm_lugre.hpp"
#include "core/effects/worm_viscous.hpp"
#include "core/moment.hpp"
#include "core/states/effect_states.hpp"

namespace wormdrive {

/// A tuple of effects that may each be absent.
template <template <class> class... Effect>
struct Optional {
  template <class T>
  using Tuple = std::tuple<std::optional<Effect<T>>...>;
};

/// Every effect that can extend the nominal drive, off unless stated; a new one is a new file and one entry here.
/// Effects at one place act in this order, each on what the one before it left.
///
/// An effect is switched by its presence, not by a zero parameter: a fit starts at zero and needs the gradient there.
template <class T>
using EffectList =
    Optional<TorqueSaturation, ActuatorDelay, ActuatorLag, DcMotor, TorqueGain, TorqueOffset, Cogging,  // actuator
             WormCoulomb, WormViscous, WormLuGre, BearingAsymmetry, HoldingBrake, WormInertia,          // worm shaft
             Vibration, TorqueMap,                                                                      // worm shaft
             Agma, FrictionMap, MeshFriction, Stribeck, FrictionAsymmetry, PositionFriction,            // mesh
             ThreadFriction, FrictionDrift, StaticFriction, GearboxHeat, MeshLuGre,                     // mesh
             TransmissionError, ToothCompliance, Backlash,                                              // mesh
             GearCoulomb, GearViscous, FrictionUnderLoad, GearInertia, HardStops,                       // gear shaft
             LoadMagnitude, LoadMap, LoadAngle, LoadSpring, LoadCrank, LoadFourBar, LoadCoupling,       // load
             EncoderDelay, EncoderScale, EncoderOffset>::Tuple<T>;                                      // sensor

/// How many states all effects may have together.
inline constexpr std::size_t effect_state_count = StateLayout<EffectList<double>>::size;

/// A moment with the states of the effects.
template <class S>
struct MomentOfEffects : Moment<S> {
  std::array<S, effect_state_count> states{};
};

}  // namespace wormdrive
