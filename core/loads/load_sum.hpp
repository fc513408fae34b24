#pragma once
#include <algorithm>
#include <limits>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/loads/angle_table.hpp"
#include "core/loads/end_stops.hpp"
#include "core/loads/fan.hpp"
#include "core/loads/gravity_arm.hpp"
#include "core/loads/timed_load.hpp"
#include "core/mode.hpp"

namespace wormdrive {

/// A list of kinds.
template <class... Kind>
struct LoadKinds {};
/// Every kind of load that is no function of time; a new one is a new file and one entry here. It names itself by
/// `kind` and `meaning` and lists its `fields()`, from which it is read, written and shown.
using SpecialLoads = LoadKinds<GravityArm, AngleTable, Fan, EndStops>;

inline TimedLoad make_load(const Signal& signal) { return {signal}; }
inline GravityLoad make_load(const GravityArm& arm) { return GravityLoad(arm); }
/// A load that enters the equations as it is stated.
template <class Load>
requires requires(const Load& load) { load.next_knot(0.0); }
Load make_load(const Load& load) { return load; }

template <class Time, class Special>
struct LoadTermOf;
template <class... Time, class... Special>
struct LoadTermOf<std::variant<Time...>, LoadKinds<Special...>> {
  using type = std::variant<Time..., Special...>;
  using Lists = std::tuple<std::vector<decltype(make_load(std::declval<const Special&>()))>...>;
};
/// One load among several that add up.
using LoadTerm = LoadTermOf<SignalTerm, SpecialLoads>::type;

/// Whether a load is a function of time.
template <class Term>
inline constexpr bool is_over_time = std::is_constructible_v<SignalTerm, const Term&>;

/// Loads of any kinds that add up, as they are stated.
struct LoadSum {
  std::vector<LoadTerm> terms;
};

/// The same as the equations use it: all functions of time in one, and every other kind for itself.
class SummedLoad {
 public:
  explicit SummedLoad(const LoadSum& stated) {
    for (const LoadTerm& term : stated.terms)
      std::visit(
          [&]<class Term>(const Term& t) {
            if constexpr (is_over_time<Term>)
              timed_.signal.terms.push_back(t);
            else
              std::get<std::vector<decltype(make_load(t))>>(lists_).push_back(make_load(t));
          },
          term);
  }

  double inertia() const {
    return folded(0.0, [](double sum, const auto& load) { return sum + load.inertia(); });
  }
  void enter(double t) {
    timed_.enter(t);
    std::apply([t](auto&... list) { (for_each(list, [t](auto& load) { load.enter(t); }), ...); }, lists_);
  }
  double next_knot(double t) const {
    return folded(timed_.next_knot(t),
                  [t](double next, const auto& load) { return std::min(next, load.next_knot(t)); });
  }
  double fastest() const {
    return folded(timed_.fastest(), [](double most, const auto& load) { return std::max(most, load.fastest()); });
  }
  double ripple() const {
    return folded(0.0, [](double most, const auto& load) { return std::max(most, load.ripple()); });
  }

  /// Load torque tau_l [N m] while the gear moves, or starts to move, in a direction ...
  template <class S>
  S torque(const Moment<S>& at, Motion motion) const {
    return torque(timed_.torque(at), at, motion);
  }
  /// ... where that of all functions of time is known.
  template <class S>
  S torque(const S& over_time, const Moment<S>& at, Motion motion) const {
    return folded(over_time, [&](const S& sum, const auto& load) {
      if constexpr (requires { load.torque(at, motion); })
        return S(sum + load.torque(at, motion));
      else
        return S(sum + load.torque(at));
    });
  }
  /// ... in the direction of its speed.
  template <class S>
  S torque(const Moment<S>& at) const {
    return torque(at, motion_of(at.omega_g));
  }

  /// Calls visit with every quantity at whose zero the torque bends.
  template <class S, class Visit>
  void for_each_bend(const Moment<S>& at, Visit&& visit) const {
    const auto of_one = [&](const auto& load) {
      if constexpr (requires { load.for_each_bend(at, visit); }) load.for_each_bend(at, visit);
    };
    std::apply([&](const auto&... list) { (for_each(list, of_one), ...); }, lists_);
  }

  /// Whether the law of a load is another one in the other direction.
  bool depends_on_direction() const {
    return folded(false, [](bool any, const auto& load) {
      return any || requires { load.torque(Moment<double>{}, Motion::forward); };
    });
  }
  /// All functions of time, or nullptr.
  const TimedLoad* over_time() const { return timed_.signal.terms.empty() ? nullptr : &timed_; }
  /// The arm, if there is nothing else.
  GravityLoad* lone_arm() {
    auto& arms = std::get<std::vector<GravityLoad>>(lists_);
    std::size_t special = 0;
    std::apply([&](const auto&... list) { ((special += list.size()), ...); }, lists_);
    return special == 1 && arms.size() == 1 && over_time() == nullptr ? &arms.front() : nullptr;
  }

 private:
  template <class List, class Visit>
  static void for_each(List& list, Visit visit) {
    for (auto& load : list) visit(load);
  }
  /// The value after every load has changed it in turn.
  template <class Value, class Change>
  Value folded(Value value, Change change) const {
    std::apply(
        [&](const auto&... list) { (for_each(list, [&](const auto& load) { value = change(value, load); }), ...); },
        lists_);
    return value;
  }

  TimedLoad timed_;
  LoadTermOf<SignalTerm, SpecialLoads>::Lists lists_;
};

inline SummedLoad make_load(const LoadSum& sum) { return SummedLoad(sum); }

}  // namespace wormdrive
