#pragma once
#include <array>
#include <span>
#include <string_view>

#include "core/elastic/compliant_drive.hpp"
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
inline constexpr unsigned first_indicator = 40;   ///< value reference of the first event indicator
inline constexpr unsigned first_parameter = 100;  ///< and of the first parameter

/// The guards of a drive by their names, each one event indicator, whatever the mode; and the states in their order.
template <class Drive>
struct Interface;

template <class T, class Load>
struct Interface<WormDrive<T, Load>> {
  static constexpr std::array<std::string_view, 4> indicators{"gear speed", "switching surface", "forward break-in",
                                                              "backward break-in"};
  static constexpr std::array states{ScalarVariable::gear_angle, ScalarVariable::gear_speed};
  static constexpr std::array rates{ScalarVariable::gear_angle_rate, ScalarVariable::gear_speed_rate};
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

/// The same for whoever does not know the type of the drive.
struct InterfaceNames {
  std::span<const std::string_view> indicators;
  std::span<const ScalarVariable> states, rates;

  explicit InterfaceNames(bool elastic_teeth) {
    if (elastic_teeth)
      take<CompliantDrive<double, SummedLoad>>();
    else
      take<WormDrive<double, SummedLoad>>();
  }

 private:
  template <class Drive>
  void take() {
    indicators = Interface<Drive>::indicators;
    states = Interface<Drive>::states;
    rates = Interface<Drive>::rates;
  }
};

}  // namespace wormdrive
