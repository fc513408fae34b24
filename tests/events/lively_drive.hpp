#pragma once
// A drive that meets events of every kind within two seconds, none of them near to another.
#include <iostream>
#include <optional>
#include <string_view>
#include <tuple>
#include <vector>

#include "catch.hpp"
#include "events/derivatives.hpp"

namespace wormdrive::test::lively_drive {

inline constexpr double duration = 2.0;  // [s]

/// Two sinusoids against an arm.
inline RigidDrive lively(Effects<double> on = {}) {
  GravityArm arm;
  arm.amplitude = 0.033;
  arm.offset = 2.241;
  const Signal motor{{Sinusoid{.amplitude = 0.021, .frequency = 1.5, .phase = 90 * unit::degree},
                      Sinusoid{.amplitude = 0.023, .frequency = 3.119}, Constant{0.003}}};
  const auto unless_on = [&]<class E>(const E& effect) {
    auto& place = std::get<std::optional<E>>(on.list);
    if (!place) place = effect;
  };
  unless_on(WormCoulomb<double>{0.0058});
  unless_on(GearCoulomb<double>{0.0069});
  unless_on(WormViscous<double>{2e-5});
  return {GearMesh<double>(table1()), {{arm}}, on, motor};
}

inline std::vector<Parameter> in_table(const std::vector<Parameter>& all, std::string_view table) {
  std::vector<Parameter> some;
  for (const Parameter& p : all)
    if (p.table == table) some.push_back(p);
  return some;
}

/// Derivatives by some parameters of a drive along its run, in differences by such a change of its state; `what` is
/// said of it.
inline Kinds check_derivatives(std::string_view what, const RigidDrive& drive, const std::vector<Parameter>& by,
                               double change = 5e-5) {
  const auto found = agreement(drive, by, Timetable(0, duration, 0.0131), change);
  const Kinds kinds(found.series.events);
  std::cout << what << ": " << kinds.reversals << " reversals, " << kinds.captures << " captures, " << kinds.releases
            << " releases, " << kinds.flank_changes << " flank changes; series against CVODES " << found.cvodes
            << ", against differences " << found.differences << "\n";
  return kinds;
}

/// An effect alone: derivatives by its parameters along a run with every kind of event.
template <class Effect>
void check_effect(const Effect& effect, double change = 5e-5) {
  const auto drive = lively(effects(effect));
  const Kinds kinds = check_derivatives(Effect::id, drive, in_table(continuous_parameters(drive), Effect::id), change);
  CHECK(kinds.reversals >= 1);
  CHECK(kinds.captures >= 1);
  CHECK(kinds.releases >= 1);
  CHECK(kinds.flank_changes >= 1);
}

}  // namespace wormdrive::test::lively_drive
