#pragma once
#include <array>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/numbers/series.hpp"
#include "core/place.hpp"
#include "core/states/effect_states.hpp"

namespace wormdrive {

/// A motor with brushes, or the torque axis of one without, on an amplifier that gives a voltage or, with a current
/// loop, a current. With an inductance its current is a state; without one it follows voltage and speed at once. With a
/// heat capacity the temperature of its winding is a state.
template <class T>
struct DcMotor {
  static constexpr std::string_view id = "dc_motor";
  static constexpr Place place = Place::actuator;
  static constexpr std::string_view cause =
      "an amplifier gives a voltage or controls the current, and the winding's back-EMF, resistance and inductance "
      "determine the current";
  static constexpr std::string_view law =
      "inductance I' = U - R I - torque_constant theta_w', tau_m = torque_constant I, with U = amplifier_gain u within "
      "+-supply_voltage and R = resistance (1 + temperature_coefficient h), where heat_capacity h' = R I^2 - "
      "h/thermal_resistance; with a current loop U = R I + torque_constant theta_w' + 2 pi current_bandwidth "
      "inductance (u/torque_constant - I) within +-supply_voltage, with u/torque_constant within +-current_limit; "
      "without one, but with a current_limit, U lies between the voltages that a loop of limiter_bandwidth would give "
      "for -current_limit and for +current_limit";
  static constexpr std::string_view source =
      "W. Leonhard, Control of Electrical Drives, 3rd ed., Springer 2001, chapter 5";
  T resistance{};
  T torque_constant{};
  std::optional<T> inductance{};
  std::optional<T> supply_voltage{};
  std::optional<T> amplifier_gain{};
  std::optional<T> current_bandwidth{};
  std::optional<T> current_limit{};
  std::optional<T> limiter_bandwidth{};
  std::optional<T> heat_capacity{};
  std::optional<T> thermal_resistance{};
  std::optional<T> temperature_coefficient{};

  static constexpr auto fields() {
    using P = DcMotor;
    constexpr Presence o = Presence::optional;
    return std::tuple{
        Field{&P::resistance, "resistance", unit::ohm, bounds::positive, "of the winding with its brushes"},
        Field{&P::torque_constant, "torque_constant", unit::newton_metre_per_ampere, bounds::positive,
              "torque per current, and back-EMF per speed of the worm"},
        Field{&P::inductance, "inductance", unit::henry, bounds::not_negative,
              "of the winding; 0 if not stated, and then the current follows the voltage at once", o},
        Field{&P::supply_voltage, "supply_voltage", unit::volt, bounds::positive,
              "largest voltage in either direction; unlimited if not stated", o},
        Field{&P::amplifier_gain, "amplifier_gain", unit::volt_per_newton_metre, bounds::positive,
              "voltage per commanded torque; if not stated resistance / torque_constant, which gives that torque at "
              "standstill",
              o},
        Field{&P::current_bandwidth, "current_bandwidth", unit::hertz, bounds::positive,
              "of a loop that brings the current to command / torque_constant; needs inductance_H; without a loop the "
              "amplifier gives a voltage",
              o},
        Field{&P::current_limit, "current_limit", unit::ampere, bounds::positive,
              "largest current in either direction that the loop demands or that the limiter of a voltage amplifier "
              "allows; unlimited if not stated",
              o},
        Field{&P::limiter_bandwidth, "limiter_bandwidth", unit::hertz, bounds::positive,
              "of an amplifier that gives a voltage: how fast it brings the current back to its limit", o},
        Field{&P::heat_capacity, "heat_capacity", unit::joule_per_kelvin, bounds::positive,
              "of the winding and of what shares its temperature; if not stated the temperature stays constant", o},
        Field{&P::thermal_resistance, "thermal_resistance", unit::kelvin_per_watt, bounds::positive,
              "from the winding to its surroundings; if not stated no heat leaves", o},
        Field{&P::temperature_coefficient, "temperature_coefficient", unit::per_kelvin, bounds::not_negative,
              "rise of the resistance per kelvin, 0.0039 for copper; 0 if not stated", o}};
  }

  // ---- its state ----------------------------------------------------------------------------------------------

  static constexpr std::array states{EffectState{"current", unit::ampere},
                                     EffectState{"temperature_rise", unit::kelvin}};
  static constexpr std::string_view without_states = "state neither inductance_H nor heat_capacity_J_per_K";
  bool has_inductance() const { return inductance && *inductance > T(0); }
  bool has_state(std::size_t k) const { return k == 0 ? has_inductance() : heat_capacity.has_value(); }
  /// I' [A/s] and h' [K/s]; the winding warms up from its surroundings on.
  template <class S>
  std::array<S, 2> state_rates(const S& command, const Moment<S>& at, Motion, const std::array<S, 2>& state) const {
    const S R = hot_resistance(state), I = current(command, at, state);
    std::array<S, 2> rates{S(0.0), S(0.0)};
    if (has_inductance()) rates[0] = (voltage(command, at, state) - torque_constant * at.omega_w - R * I) / *inductance;
    if (!heat_capacity) return rates;
    rates[1] = R * I * I / *heat_capacity;
    if (thermal_resistance) rates[1] = rates[1] - state[1] / (*thermal_resistance * *heat_capacity);
    return rates;
  }
  /// Calls visit with what is zero where the current loop reaches the voltage of the supply, or leaves it, and where
  /// the limiter does so with that of the amplifier.
  template <class S, class Visit>
  void for_each_bend(const S& command, const Moment<S>& at, const std::array<S, 2>& state, Visit&& visit) const {
    if (!limits_voltage()) return;
    if (!current_bandwidth) {
      const auto [lowest, highest] = limiting_voltages(at, state);
      visit(S(highest - gain() * command));
      visit(S(gain() * command - lowest));
    }
    if (!supply_voltage) return;
    const S asked = asked_voltage(command, at, state);
    visit(S(*supply_voltage - asked));
    visit(S(*supply_voltage + asked));
  }

  // ---- what it does -------------------------------------------------------------------------------------------

  /// U [V], without a state that of a current that is what is commanded ...
  template <class S>
  S voltage(const S& command, const Moment<S>& at) const {
    if (!current_bandwidth) return gain() * command;
    return resistance * current(command, at) + torque_constant * at.omega_w;
  }
  /// ... and with the states.
  template <class S>
  S voltage(const S& command, const Moment<S>& at, const std::array<S, 2>& state) const {
    if (!limits_voltage()) return gain() * command;
    const S asked = asked_voltage(command, at, state);
    return supply_voltage ? within(S(-*supply_voltage), S(*supply_voltage), asked) : asked;
  }
  /// I [A] without a state.
  template <class S>
  S current(const S& command, const Moment<S>& at) const {
    if (current_bandwidth) return command / torque_constant;
    return (gain() * command - torque_constant * at.omega_w) / resistance;
  }
  /// R of a winding that has warmed up [ohm].
  template <class S>
  S hot_resistance(const std::array<S, 2>& state) const {
    return temperature_coefficient ? S(resistance * (S(T(1)) + *temperature_coefficient * state[1])) : S(resistance);
  }
  /// I with the states [A].
  template <class S>
  S current(const S& command, const Moment<S>& at, const std::array<S, 2>& state) const {
    if (has_inductance()) return state[0];
    return (gain() * command - torque_constant * at.omega_w) / hot_resistance(state);
  }
  /// Motor torque [N m] for a command, with the current that follows at once ...
  template <class S>
  S motor_torque(const S& command, const Moment<S>& at) const {
    return torque_constant * current(command, at);
  }
  /// ... and with its states.
  template <class S>
  S motor_torque(const S& command, const Moment<S>& at, const std::array<S, 2>& state) const {
    return torque_constant * current(command, at, state);
  }
  /// Largest magnitude of the command [N m], infinity without a limit.
  T torque_limit() const {
    const T none(std::numeric_limits<double>::infinity());
    if (current_bandwidth) return current_limit ? torque_constant * *current_limit : none;
    return supply_voltage ? *supply_voltage / gain() : none;
  }

 private:
  /// Whether the amplifier looks at the current.
  bool limits_voltage() const { return current_bandwidth || current_limit; }
  template <class S>
  static S within(const S& lowest, const S& highest, const S& x) {
    return is_positive(S(x - highest)) ? highest : is_positive(S(lowest - x)) ? lowest : x;
  }
  /// What the amplifier would give if its supply had no end [V].
  template <class S>
  S asked_voltage(const S& command, const Moment<S>& at, const std::array<S, 2>& state) const {
    if (current_bandwidth) return loop_voltage(*current_bandwidth, S(command / torque_constant), at, state);
    const auto [lowest, highest] = limiting_voltages(at, state);
    return within(lowest, highest, S(gain() * command));
  }
  /// Between them the limiter leaves a voltage alone [V].
  template <class S>
  std::pair<S, S> limiting_voltages(const Moment<S>& at, const std::array<S, 2>& state) const {
    return {loop_voltage(*limiter_bandwidth, S(-*current_limit), at, state),
            loop_voltage(*limiter_bandwidth, S(*current_limit), at, state)};
  }
  /// Voltage of a proportional-integral current loop whose integral has cancelled the pole of the winding and whose
  /// feedforward the back-EMF [V]: the current follows as a lag of first order, unless the supply ends it.
  template <class S>
  S loop_voltage(const T& bandwidth, const S& asked, const Moment<S>& at, const std::array<S, 2>& state) const {
    const T omega_c = T(2.0 * std::numbers::pi) * bandwidth;
    return hot_resistance(state) * state[0] + torque_constant * at.omega_w + *inductance * omega_c * (asked - state[0]);
  }
  T gain() const { return amplifier_gain ? *amplifier_gain : resistance / torque_constant; }
};

}  // namespace wormdrive
