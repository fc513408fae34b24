#pragma once
#include <limits>
#include <optional>
#include <tuple>

#include "bench/plant.hpp"
#include "bench/rubbing_plant.hpp"
#include "bench/sundials_by_hand.hpp"
#include "core/load.hpp"
#include "core/worm_drive.hpp"
#include "events/solver_settings.hpp"

namespace bench {

using Drive = wormdrive::WormDrive<double, wormdrive::GravityLoad>;

inline constexpr double end_time = 2.0;  ///< of the open loop [s]
inline constexpr double never = std::numeric_limits<double>::infinity();

/// Table 1.
inline wormdrive::GearMesh<double> table_1() {
  return wormdrive::GearMesh<double>(wormdrive::MeshParameters<double>{.i = 60,
                                                                       .lambda = 4 * wormdrive::unit::degree,
                                                                       .phi_n = 20 * wormdrive::unit::degree,
                                                                       .lw = 0.011,
                                                                       .lg = 0.045,
                                                                       .mu = 0.25,
                                                                       .Jw = 2.53e-5,
                                                                       .Jg = 7.39e-4});
}

/// The same drive as Plant, from wormdrive's own parts.
inline Drive drive_of(const Case& inputs, const wormdrive::Effects<double>& effects = {}) {
  wormdrive::GravityArm arm;
  arm.amplitude = inputs.load_cosine != 0.0 ? inputs.load_cosine : inputs.load_sine;
  arm.offset = inputs.load_cosine != 0.0 ? 0.0 : -pi / 2;
  wormdrive::Signal motor;
  if (inputs.motor != 0.0)
    motor.terms.push_back(wormdrive::Sinusoid{inputs.motor, inputs.omega / (2 * pi), inputs.phase});
  return {table_1(), wormdrive::make_load(arm), effects, motor};
}

/// The same as what a RubbingPlant has.
inline wormdrive::Effects<double> effects_of(const Rubbing& r) {
  wormdrive::Effects<double> on;
  const auto set = [&]<class Effect>(const Effect& effect) { std::get<std::optional<Effect>>(on.list) = effect; };
  set(wormdrive::Stribeck<double>{.drop = r.drop, .speed = r.speed});
  set(wormdrive::WormCoulomb<double>{r.worm_coulomb});
  set(wormdrive::GearCoulomb<double>{r.gear_coulomb});
  set(wormdrive::WormViscous<double>{r.worm_viscous});
  set(wormdrive::GearViscous<double>{r.gear_viscous});
  return on;
}

inline wormdrive::SolverSettings settings(wormdrive::Method method, double tolerance) {
  return {.method = method, .relative_tolerance = tolerance, .absolute_tolerance = absolute_part * tolerance};
}

}  // namespace bench
