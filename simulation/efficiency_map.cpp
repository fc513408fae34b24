#include "simulation/efficiency_map.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "core/energy.hpp"
#include "core/steady.hpp"
#include "description/build.hpp"
#include "simulation/steady_scenario.hpp"

namespace wormdrive {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// What comes out over what goes in. A load that is driven takes power, one that drives returns some to the motor, or
/// nothing where the motor has to help it along.
double efficiency(const Power& power) {
  if (power.load < 0.0) return power.motor > 0.0 ? -power.load / power.motor : none;
  return power.motor < 0.0 ? -power.motor / power.load : 0.0;
}

template <class Drive>
OperatingPoint operating_point(Drive& drive, double theta_g, double worm_speed, double load_torque) {
  drive.enter(0.0);
  const double command = steady_torque(drive, worm_speed, theta_g, 0.0);
  OperatingPoint point{worm_speed, load_torque, none, none, none, none, none};
  if (!std::isfinite(command) || std::abs(command) > drive.torque_limit()) return point;
  drive.command(0.0, command);
  typename Drive::Instant now;
  now.x = {theta_g, worm_speed / drive.mesh().i};
  now.mode = drive.settle(now);
  if (!is_within_amplifier(drive.effects(), drive.observe(now).winding)) return point;
  const Power found = power(drive, now);
  const double share = efficiency(found);
  if (std::isnan(share)) return point;
  return {worm_speed, load_torque, command, found.motor, found.load, found.loss, share};
}

}  // namespace

std::vector<OperatingPoint> efficiency_map(Scenario scenario, const std::vector<double>& worm_speeds,
                                           const std::vector<double>& load_torques) {
  scenario = with_open_brake(std::move(scenario));
  scenario.motor = {};
  scenario.effects.for_each([]<class Effect>(std::optional<Effect>& effect) {
    if constexpr (Effect::place == Place::load) effect.reset();
    // what is late makes no difference where all is constant
    if constexpr (requires { effect->delay(); }) effect.reset();
    if constexpr (requires { effect->lag(); }) effect.reset();
  });
  std::vector<OperatingPoint> map;
  for (const double speed : worm_speeds)
    for (const double load : load_torques) {
      scenario.load = Signal{{Constant{load}}};
      auto drive = make_drive(scenario);
      map.push_back(operating_point(drive, scenario.initial.theta_g, speed, load));
    }
  return map;
}

}  // namespace wormdrive
