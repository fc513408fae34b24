#pragma once
#include <cstddef>
#include <utility>
#include <variant>

#include "core/loads/angle_table.hpp"
#include "core/loads/gravity_arm.hpp"
#include "core/loads/timed_load.hpp"

namespace wormdrive {

/// Every kind of load as it is stated; a new one is a new file and one entry here. It names itself by `kind` and
/// `meaning` and lists its `fields()`, from which it is read, written and shown.
using LoadParameters = std::variant<Signal, GravityArm, AngleTable>;

/// Calls visit.template operator()<Load>() for every kind of load but the functions of time.
template <class Visit>
constexpr void for_each_load(Visit&& visit) {
  [&]<std::size_t... K>(std::index_sequence<K...>) {
    (visit.template operator()<std::variant_alternative_t<K + 1, LoadParameters>>(), ...);
  }
  (std::make_index_sequence<std::variant_size_v<LoadParameters> - 1>());
}

inline TimedLoad make_load(const Signal& signal) { return {signal}; }
inline GravityLoad make_load(const GravityArm& arm) { return GravityLoad(arm); }
inline TableLoad make_load(const AngleTable& table) { return TableLoad(table); }
/// A load that enters the equations as it is stated.
template <class Load>
requires requires(const Load& load) { load.next_knot(0.0); }
Load make_load(const Load& load) { return load; }

}  // namespace wormdrive
