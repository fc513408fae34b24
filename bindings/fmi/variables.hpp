#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

#include "core/elastic/compliant_drive.hpp"
#include "core/elastic/elastic_teeth.hpp"
#include "core/load.hpp"
#include "core/worm_drive.hpp"

namespace wormdrive {

/// Value references of an FMU's variables that are not parameters; those of real numbers, of whole ones, of the clock.
enum class ScalarVariable : unsigned {
  gear_angle,
  gear_speed,
  gear_angle_rate,
  gear_speed_rate,
  worm_angle,
  worm_speed,
  worm_angle_rate,
  worm_speed_rate,
  motor_torque,
  normal_force,
  measured_angle,
  event_time,
  reference_angle,
  reference_speed,
  time,
  controller_torque,
  motion = 20,
  flank,
  gear_motion,
  event_count,
  sample_clock = 30,
};
inline constexpr unsigned first_indicator = 40;     ///< value reference of the first event indicator
inline constexpr unsigned first_effect_state = 50;  ///< of the first state of an effect, by its place among all
inline constexpr unsigned first_effect_rate = 75;   ///< and of its rate
inline constexpr unsigned first_parameter = 100;    ///< and of the first parameter
static_assert(first_effect_state + effect_state_count <= first_effect_rate &&
              first_effect_rate + effect_state_count <= first_parameter);

/// Value references of a drive's own numbers, and behind them of as many of its effects.
template <std::size_t count, std::size_t own>
constexpr std::array<ScalarVariable, count> and_of_effects(const std::array<ScalarVariable, own>& first,
                                                           unsigned first_of_effects) {
  std::array<ScalarVariable, count> all{};
  for (std::size_t k = 0; k < count; ++k)
    all[k] = k < own ? first[k] : static_cast<ScalarVariable>(first_of_effects + (k - own));
  return all;
}

/// The guards of a drive by their names, each one event indicator, whatever the mode; and the states in their order.
template <class Drive>
struct Interface;

template <class T, class Load, bool with_states>
struct Interface<WormDrive<T, Load, with_states>> {
  static constexpr std::size_t count = WormDrive<T, Load, with_states>::state_size;
  static constexpr std::array<std::string_view, 5> names{"gear speed", "switching surface", "forward break-in",
                                                         "backward break-in", "hard stop"};
  static constexpr std::span indicators = std::span(names).first(with_states ? 5 : 4);
  static constexpr auto states =
      and_of_effects<count>(std::array{ScalarVariable::gear_angle, ScalarVariable::gear_speed}, first_effect_state);
  static constexpr auto rates = and_of_effects<count>(
      std::array{ScalarVariable::gear_angle_rate, ScalarVariable::gear_speed_rate}, first_effect_rate);
};

template <class T, class Load>
struct Interface<CompliantDrive<T, Load>> {
  static constexpr std::array<std::string_view, 9> indicators{"normal force",
                                                              "left gap",
                                                              "right gap",
                                                              "worm speed",
                                                              "forward break-in of the worm",
                                                              "backward break-in of the worm",
                                                              "gear speed",
                                                              "forward break-in of the gear",
                                                              "backward break-in of the gear"};
  static constexpr std::array states{ScalarVariable::worm_angle, ScalarVariable::worm_speed, ScalarVariable::gear_angle,
                                     ScalarVariable::gear_speed};
  static constexpr std::array rates{ScalarVariable::worm_angle_rate, ScalarVariable::worm_speed_rate,
                                    ScalarVariable::gear_angle_rate, ScalarVariable::gear_speed_rate};
};

/// The places of the states that a drive has among those of its type: an effect that is off has none.
template <class Drive>
std::vector<std::size_t> present_states(const Effects<double>& effects) {
  std::vector<std::size_t> places;
  for (std::size_t k = 0; k < Interface<Drive>::states.size(); ++k)
    if (static_cast<unsigned>(Interface<Drive>::states[k]) < first_effect_state) places.push_back(k);
  if (const std::size_t own = places.size(); own < Interface<Drive>::states.size())
    effects.for_each_state(
        [&](std::string_view, const EffectState&, std::size_t place) { places.push_back(own + place); });
  return places;
}

/// The same for whoever does not know the type of the drive.
struct InterfaceNames {
  std::span<const std::string_view> indicators;
  std::vector<ScalarVariable> states, rates;

  explicit InterfaceNames(const Effects<double>& effects) {
    if (has_elastic_teeth(effects))
      take<CompliantDrive<double, SummedLoad>>(effects);
    else if (effects.have_states())
      take<WormDrive<double, SummedLoad, true>>(effects);
    else
      take<WormDrive<double, SummedLoad>>(effects);
  }

  /// Whether this is a state that there is, or its rate.
  bool has_state(ScalarVariable variable) const {
    const auto in = [variable](const auto& list) {
      return std::find(list.begin(), list.end(), variable) != list.end();
    };
    return in(states) || in(rates);
  }

 private:
  template <class Drive>
  void take(const Effects<double>& effects) {
    indicators = Interface<Drive>::indicators;
    for (const std::size_t k : present_states<Drive>(effects)) {
      states.push_back(Interface<Drive>::states[k]);
      rates.push_back(Interface<Drive>::rates[k]);
    }
  }
};

}  // namespace wormdrive
