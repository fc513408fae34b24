#pragma once
#include <array>
#include <limits>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/place.hpp"
#include "core/states/effect_states.hpp"

namespace wormdrive {

/// A motor with brushes on an amplifier that gives a voltage. With an inductance its current is a state; without one
/// the current follows voltage and speed at once.
template <class T>
struct DcMotor {
  static constexpr std::string_view id = "dc_motor";
  static constexpr Place place = Place::actuator;
  static constexpr std::string_view cause =
      "an amplifier gives a voltage, and back-EMF, resistance and inductance of the winding say what current flows";
  static constexpr std::string_view law =
      "inductance I' = U - resistance I - torque_constant theta_w', tau_m = torque_constant I, with U = amplifier_gain "
      "u within +-supply_voltage";
  static constexpr std::string_view source =
      "W. Leonhard, Control of Electrical Drives, 3rd ed., Springer 2001, chapter 5";
  T resistance{};
  T torque_constant{};
  std::optional<T> inductance{};
  std::optional<T> supply_voltage{};
  std::optional<T> amplifier_gain{};

  static constexpr auto fields() {
    using P = DcMotor;
    constexpr Presence o = Presence::optional;
    return std::tuple{
        Field{&P::resistance, "resistance", unit::ohm, bounds::positive, "of the winding with its brushes"},
        Field{&P::torque_constant, "torque_constant", unit::newton_metre_per_ampere, bounds::positive,
              "torque per current, and back-EMF per speed of the worm"},
        Field{&P::inductance, "inductance", unit::henry, bounds::not_negative,
              "of the winding; 0, if not stated: the current follows at once", o},
        Field{&P::supply_voltage, "supply_voltage", unit::volt, bounds::positive,
              "largest voltage in either direction; unlimited if not stated", o},
        Field{&P::amplifier_gain, "amplifier_gain", unit::volt_per_newton_metre, bounds::positive,
              "voltage per commanded torque; if not stated resistance / torque_constant, which gives that torque at "
              "standstill",
              o}};
  }

  // ---- its state ----------------------------------------------------------------------------------------------

  static constexpr std::array states{EffectState{"current", unit::ampere}};
  bool has_states() const { return inductance && *inductance > T(0); }
  /// I' [A/s].
  template <class S>
  std::array<S, 1> state_rates(const S& command, const Moment<S>& at, const std::array<S, 1>& state) const {
    return {(voltage(command) - torque_constant * at.omega_w - resistance * state[0]) / *inductance};
  }
  /// How fast the state settles [1/s].
  T fastest_state() const { return resistance / *inductance; }

  // ---- what it does -------------------------------------------------------------------------------------------

  /// U [V].
  template <class S>
  S voltage(const S& command) const {
    return gain() * command;
  }
  /// I [A] without a state.
  template <class S>
  S current(const S& command, const Moment<S>& at) const {
    return (voltage(command) - torque_constant * at.omega_w) / resistance;
  }
  /// Motor torque [N m] for a command, with the current that follows at once ...
  template <class S>
  S motor_torque(const S& command, const Moment<S>& at) const {
    return torque_constant * current(command, at);
  }
  /// ... and with that of the state.
  template <class S>
  S motor_torque(const S&, const Moment<S>&, const std::array<S, 1>& state) const {
    return torque_constant * state[0];
  }
  /// Largest magnitude of the command [N m], infinity without a supply that ends it.
  T torque_limit() const {
    return supply_voltage ? *supply_voltage / gain() : T(std::numeric_limits<double>::infinity());
  }

 private:
  T gain() const { return amplifier_gain ? *amplifier_gain : resistance / torque_constant; }
};

}  // namespace wormdrive
