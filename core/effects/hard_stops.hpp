#pragma once
#include <array>
#include <optional>
#include <string_view>
#include <tuple>

#include "core/field.hpp"
#include "core/moment.hpp"
#include "core/place.hpp"
#include "core/states/effect_states.hpp"

namespace wormdrive {

/// The gear runs against stops that do not yield: an impact ends its motion at once, and throws it back as far as the
/// mesh lets it. Its state is the sum of the impulses, which only impacts change.
template <class T>
struct HardStops {
  static constexpr std::string_view id = "hard_stops";
  static constexpr Place place = Place::gear_shaft;
  static constexpr std::string_view cause = "the gear runs against rigid stops at the ends of its travel";
  static constexpr std::string_view law =
      "an impulse ends the motion at a stop, another one drives the gear back as far as the mesh passes it on, with "
      "restitution^2 of the energy that the stop has taken; at rest there it takes what pushes into it";
  static constexpr std::string_view source = "W. J. Stronge, Impact Mechanics, Cambridge University Press 2000";
  std::optional<T> low{};
  std::optional<T> high{};
  T restitution{0};

  static constexpr auto fields() {
    using P = HardStops;
    constexpr Presence o = Presence::optional;
    return std::tuple{
        Field{&P::low, "angle_low", unit::degrees, bounds::any, "lowest gear angle; state either or both", o},
        Field{&P::high, "angle_high", unit::degrees, bounds::any, "highest gear angle", o},
        Field{&P::restitution, "restitution", unit::none, bounds::between(0, 1),
              "square root of the share of the energy that a stop returns", o}};
  }
  /// The stop ahead of a motion, if there is one.
  const std::optional<T>& ahead(Motion motion) const { return motion == Motion::forward ? high : low; }

  // ---- its state ----------------------------------------------------------------------------------------------

  static constexpr std::array states{
      EffectState{"impulse", unit::newton_metre_second, "sum of the impulses of the stops on the gear"}};
  static constexpr std::string_view without_states = "leave it out";
  bool has_state(std::size_t) const { return true; }
  template <class S>
  std::array<S, 1> state_rates(const S&, const Moment<S>&, Motion, const std::array<S, 1>&) const {
    return {S(0.0)};
  }
};

}  // namespace wormdrive
