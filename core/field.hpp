#pragma once
#include <array>
#include <cstddef>
#include <limits>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

#include "core/unit.hpp"

namespace wormdrive {

/// The values a field may take, in SI; an exclusive end is not a value itself.
struct Bounds {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool low_exclusive = false;
  bool high_exclusive = false;

  bool contain(double x) const {
    return (low_exclusive ? x > low : x >= low) && (high_exclusive ? x < high : x <= high);
  }
};

namespace bounds {
inline constexpr Bounds any{};
inline constexpr Bounds positive{.low = 0.0, .low_exclusive = true};
inline constexpr Bounds not_negative{.low = 0.0};
constexpr Bounds open(double low, double high) { return {low, high, true, true}; }
constexpr Bounds between(double low, double high) { return {low, high, false, false}; }
}  // namespace bounds

enum class Presence { required, optional };

/// One parameter of a struct: the single description that TOML, HDF5, fits and documentation share.
template <class Owner, class Value>
struct Field {
  Value Owner::*member;
  std::string_view name;  ///< the key without its unit, "lead_angle"
  Unit unit;
  Bounds bounds;
  std::string_view meaning;  ///< one phrase, no full stop
  Presence presence = Presence::required;
};
template <class Owner, class Value>
Field(Value Owner::*, std::string_view, Unit, Bounds, std::string_view, Presence = {}) -> Field<Owner, Value>;

/// One of several words: a flag or an enum whose values stand in the order of the words. The first word holds where
/// none is stated.
template <class Owner, class Value, std::size_t n>
struct Choice {
  Value Owner::*member;
  std::string_view key;
  std::array<std::string_view, n> words;
  std::string_view meaning;

  std::string_view word(const Owner& of) const { return words[static_cast<std::size_t>(of.*member)]; }
  /// The value of one of the words; of any other text that of the last.
  void set(Owner& of, std::string_view word) const {
    std::size_t k = 0;
    while (k + 1 < n && words[k] != word) ++k;
    of.*member = static_cast<Value>(k);
  }
};
template <class Owner, class Value, std::size_t n>
Choice(Value Owner::*, std::string_view, std::array<std::string_view, n>, std::string_view) -> Choice<Owner, Value, n>;

/// Calls visit(element) for every element of a tuple; std::apply does the same and takes the compiler far longer.
template <class Tuple, class Visit>
constexpr void for_each_in(Tuple& tuple, Visit& visit) {
  [&]<std::size_t... k>(std::index_sequence<k...>) { (visit(std::get<k>(tuple)), ...); }
  (std::make_index_sequence<std::tuple_size_v<std::remove_const_t<Tuple>>>());
}

/// Calls visit(field) for every field of a parameter struct, in the order of its list.
template <class Owner, class Visit>
constexpr void for_each_field(Visit&& visit) {
  const auto fields = Owner::fields();
  for_each_in(fields, visit);
}

/// Calls visit(choice) for every choice of a parameter struct, in the order of its list; many have none.
template <class Owner, class Visit>
constexpr void for_each_choice(Visit&& visit) {
  if constexpr (requires { Owner::choices(); }) {
    const auto choices = Owner::choices();
    for_each_in(choices, visit);
  }
}

}  // namespace wormdrive
