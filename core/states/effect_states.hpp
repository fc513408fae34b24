#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "core/unit.hpp"

namespace wormdrive {

/// What an effect calls a state of its own; starting_states() says where it starts. With a meaning it is a column of
/// the results.
struct EffectState {
  std::string_view name;
  Unit unit;
  std::string_view meaning{};
};

/// Effects that may have states: they name them, say which they have with their parameters, and give rates.
template <class Effect>
concept MayHaveStates = requires(const Effect& effect) {
  Effect::states;
  effect.has_state(std::size_t{});
};

/// Whether an effect has any state with its parameters.
template <MayHaveStates Effect>
bool has_states(const Effect& effect) {
  for (std::size_t k = 0; k < Effect::states.size(); ++k)
    if (effect.has_state(k)) return true;
  return false;
}

/// The states of the effects of a list, one effect's behind the other's; an effect that is off has its own, too, and
/// they do not change.
template <class List>
struct StateLayout;
template <class... Effect>
struct StateLayout<std::tuple<std::optional<Effect>...>> {
  /// How many an effect may have.
  template <class One>
  static constexpr std::size_t count() {
    if constexpr (MayHaveStates<One>)
      return One::states.size();
    else
      return 0;
  }
  static constexpr std::size_t size = (count<Effect>() + ... + 0);

  /// Calls visit(id of its effect, state, its place among all) for every state that an effect may have.
  template <class Visit>
  static void for_each(Visit&& visit) {
    const auto each = [&]<class One>() {
      if constexpr (MayHaveStates<One>)
        for (std::size_t k = 0; k < One::states.size(); ++k) visit(One::id, One::states[k], first<One>() + k);
    };
    (each.template operator()<Effect>(), ...);
  }
  /// Where those of an effect begin.
  template <class Sought>
  static constexpr std::size_t first() {
    std::size_t at = 0;
    bool found = false;
    ((found = found || std::is_same_v<Effect, Sought>, at += found ? 0 : count<Effect>()), ...);
    return at;
  }
  /// Those of an effect out of all.
  template <class Sought, class S>
  static std::array<S, count<Sought>()> of(const std::array<S, size>& all) {
    std::array<S, count<Sought>()> own;
    for (std::size_t k = 0; k < own.size(); ++k) own[k] = all[first<Sought>() + k];
    return own;
  }
};

}  // namespace wormdrive
