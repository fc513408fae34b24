#pragma once
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

}  // namespace wormdrive
