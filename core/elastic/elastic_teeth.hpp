#pragma once
#include <optional>
#include <tuple>

#include "core/effects.hpp"
#include "core/elastic/contact_law.hpp"

namespace wormdrive {

/// Whether effects make the teeth elastic, so that the compliant drive has to stand for the rigid one.
template <class T>
bool has_elastic_teeth(const Effects<T>& effects) {
  return std::get<std::optional<ToothCompliance<T>>>(effects.list).has_value();
}

/// How the teeth touch that effects make elastic; the damping that is stated selects the law.
template <class T>
ToothContact<T> tooth_contact(const Effects<T>& effects) {
  const ToothCompliance<T>& teeth = *std::get<std::optional<ToothCompliance<T>>>(effects.list);
  const auto& backlash = std::get<std::optional<Backlash<T>>>(effects.list);
  const T gap = backlash ? backlash->gap : T(0);
  if (teeth.limited_damping) return {LimitedDamper<T>{teeth.stiffness, *teeth.limited_damping}, gap};
  return {HuntCrossley<T>{teeth.stiffness, teeth.growing_damping.value_or(T(0))}, gap};
}

}  // namespace wormdrive
