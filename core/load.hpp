#pragma once
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "core/loads/load_sum.hpp"

namespace wormdrive {

/// A load as it is stated. A function of time alone and an arm alone are known to the formulas of solvers; everything
/// else is a sum, if only of one.
using LoadParameters = std::variant<Signal, GravityArm, LoadSum>;

/// What loads that add up come to, each in its plainest form.
inline LoadParameters load_of(std::vector<LoadTerm> terms) {
  Signal over_time;
  for (const LoadTerm& term : terms)
    std::visit(
        [&]<class Term>(const Term& t) {
          if constexpr (is_over_time<Term>) over_time.terms.push_back(t);
        },
        term);
  if (over_time.terms.size() == terms.size()) return over_time;
  if (terms.size() == 1)
    if (const auto* const arm = std::get_if<GravityArm>(&terms.front())) return *arm;
  return LoadSum{std::move(terms)};
}

/// The same in the form that every load has.
inline LoadSum sum_of(const LoadParameters& load) {
  if (const auto* const sum = std::get_if<LoadSum>(&load)) return *sum;
  if (const auto* const arm = std::get_if<GravityArm>(&load)) return {{*arm}};
  LoadSum sum;
  for (const SignalTerm& term : std::get<Signal>(load).terms)
    std::visit([&](const auto& t) { sum.terms.emplace_back(t); }, term);
  return sum;
}

/// Calls visit.template operator()<Load>() for every kind of load but the functions of time.
template <class Visit>
constexpr void for_each_load(Visit&& visit) {
  [&]<class... Load>(LoadKinds<Load...>) { (visit.template operator()<Load>(), ...); }(SpecialLoads{});
}

}  // namespace wormdrive
