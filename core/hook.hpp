#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <tuple>
#include <type_traits>
#include <utility>

namespace wormdrive {

/// Whether an effect has a hook that makes another one of a value, given what else the hook looks at.
template <class Hook, class Effect, class... Values>
concept Hooks = requires(const Hook& hook, const Effect& effect, const Values&... values) {
  hook(effect, values...);
};

/// Places in a list of optional effects of those that have the hook.
template <class Hook, class... Values, class... Effect>
consteval auto hooked(const std::tuple<std::optional<Effect>...>*) {
  constexpr std::array has{Hooks<Hook, Effect, Values...>...};
  std::array<std::size_t, std::count(has.begin(), has.end(), true)> places{};
  for (std::size_t k = 0, n = 0; k < has.size(); ++k)
    if (has[k]) places[n++] = k;
  return places;
}

/// The value after every effect of a list that is on and has the hook has changed it in turn: hook(effect, value,
/// at...) is its next value. Effects without the hook are left out beforehand: a visit of all of them would be
/// instantiated for every place and every scalar. A hook captures nothing: clang 14 does not survive the question
/// whether it fits.
template <class List, class Value, class Hook, class... At>
Value through(const List& list, Value value, Hook hook, const At&... at) {
  static_assert(std::is_empty_v<Hook>, "give what the hook looks at behind it, as `at`");
  static constexpr auto places = hooked<Hook, Value, At...>(static_cast<const List*>(nullptr));
  [&]<std::size_t... K>(std::index_sequence<K...>) {
    ((std::get<places[K]>(list) ? void(value = hook(*std::get<places[K]>(list), value, at...)) : void()), ...);
  }
  (std::make_index_sequence<places.size()>());
  return value;
}

}  // namespace wormdrive
