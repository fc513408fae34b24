#pragma once
#include <string_view>
#include <tuple>
#include <variant>

#include "core/field.hpp"

namespace wormdrive {

/// Elastic contact whose damping grows with the penetration, Wn = k d (1 + c d').
///
/// Source: K. Hunt, F. Crossley, Coefficient of restitution interpreted as damping in vibroimpact, J. Appl. Mech. 42
/// (1975) 440-445, with the exponent 1 of a line contact.
template <class T>
struct HuntCrossley {
  static constexpr std::string_view kind = "hunt_crossley";
  static constexpr std::string_view meaning = "damping that grows with the penetration";
  T stiffness{};  ///< k [N/m]
  T damping{};    ///< c [s/m]

  static constexpr auto fields() {
    using P = HuntCrossley;
    return std::tuple{Field{&P::stiffness, "stiffness", unit::newton_per_metre, bounds::positive,
                            "normal force per normal deflection of the teeth"},
                      Field{&P::damping, "damping", unit::second_per_metre, bounds::not_negative,
                            "share of the elastic force that damping adds per approach speed"}};
  }
  /// Normal force [N] at a penetration d [m] and its rate v [m/s]; negative where the contact has opened.
  template <class S>
  S force(const S& d, const S& v) const {
    return stiffness * d * (T(1) + damping * v);
  }
  /// What damping adds to the force at most per approach speed [N s/m], at a penetration d [m].
  T per_speed(const T& d) const { return stiffness * damping * d; }
  /// Distance from touching [m]: positive where the teeth cannot push each other.
  template <class S>
  S apart(const S& d, const S& v) const {
    return d > S(T(0)) ? S(-d * (T(1) + damping * v)) : S(-d);
  }
};

/// Spring and damper side by side, the damping force never larger than the elastic one, Wn = k d + min(k d, D d').
///
/// Source: ElastoBacklash of the Modelica Standard Library 4.1.0.
template <class T>
struct LimitedDamper {
  static constexpr std::string_view kind = "limited_damper";
  static constexpr std::string_view meaning = "viscous damping, at most as large as the elastic force";
  T stiffness{};  ///< k [N/m]
  T damping{};    ///< D [N s/m]

  static constexpr auto fields() {
    using P = LimitedDamper;
    return std::tuple{Field{&P::stiffness, "stiffness", unit::newton_per_metre, bounds::positive,
                            "normal force per normal deflection of the teeth"},
                      Field{&P::damping, "damping", unit::newton_second_per_metre, bounds::not_negative,
                            "normal force per approach speed of the teeth"}};
  }
  /// Normal force [N] at a penetration d [m] and its rate v [m/s]; negative where the contact has opened.
  template <class S>
  S force(const S& d, const S& v) const {
    const S elastic = stiffness * d, viscous = damping * v;
    return elastic + (viscous < elastic ? viscous : elastic);
  }
  /// What damping adds to the force at most per approach speed [N s/m], at a penetration d [m].
  T per_speed(const T&) const { return damping; }
  /// Distance from touching [m]: positive where the teeth cannot push each other.
  template <class S>
  S apart(const S& d, const S& v) const {
    return v < S(T(0)) ? S(-d - damping / stiffness * v) : S(-d);
  }
};

/// Every law of contact; a new one is one more struct and one entry here.
template <class T>
using ContactLaw = std::variant<HuntCrossley<T>, LimitedDamper<T>>;

/// How two teeth touch: the law of their contact and the gap in which they do not.
template <class T>
struct ToothContact {
  ContactLaw<T> law{};
  T backlash{};  ///< play of the gear with the worm held, from flank to flank [rad]

  /// Normal force [N], not yet cut at zero.
  template <class S>
  S force(const S& d, const S& v) const {
    return std::visit([&](const auto& by) { return by.force(d, v); }, law);
  }
  template <class S>
  S apart(const S& d, const S& v) const {
    return std::visit([&](const auto& by) { return by.apart(d, v); }, law);
  }
  T per_speed(const T& d) const {
    return std::visit([&](const auto& by) { return by.per_speed(d); }, law);
  }
  /// k [N/m]
  T stiffness() const {
    return std::visit([](const auto& by) { return by.stiffness; }, law);
  }
};

}  // namespace wormdrive
