#pragma once
#include <optional>
#include <string_view>

#include "core/effects.hpp"

namespace wormdrive {

/// An effect with states: its id, and how a scenario states it so that it has none.
struct EffectWithStates {
  std::string_view id, without;
};

/// The first effect that has states, if any has.
template <class T>
std::optional<EffectWithStates> first_with_states(const Effects<T>& effects) {
  std::optional<EffectWithStates> first;
  effects.for_each([&]<class E>(const std::optional<E>& effect) {
    if constexpr (MayHaveStates<E>)
      if (!first && effect && has_states(*effect)) first = {E::id, E::without_states};
  });
  return first;
}

}  // namespace wormdrive
