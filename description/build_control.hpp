#pragma once
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <optional>
#include <vector>

#include "control/lemma1_conditions.hpp"
#include "core/numbers/sine_cosine.hpp"
#include "description/build.hpp"
#include "description/control_scenario.hpp"

namespace wormdrive {

/// The sum of constant torques [N m]; nothing if one of the terms varies.
inline std::optional<double> constant_torque(const Signal& signal) {
  double sum = 0.0;
  for (const SignalTerm& term : signal.terms)
    if (const auto* constant = std::get_if<Constant>(&term))
      sum += constant->torque;
    else
      return std::nullopt;
  return sum;
}

/// Arms and constants that add up are one arm and one constant; whether there is nothing else in a sum.
inline bool add_to_nominal(const LoadSum& sum, NominalModel& nominal) {
  std::complex<double> arm;
  bool whole = true;
  for (const LoadTerm& term : sum.terms) {
    if (const auto* const one = std::get_if<GravityArm>(&term)) {
      const auto [sine, cosine] = sine_and_cosine(one->offset);
      arm += one->torque_amplitude() * std::complex<double>(cosine, sine);
    } else if (const auto* const constant = std::get_if<Constant>(&term)) {
      nominal.load_constant += constant->torque;
    } else {
      whole = false;
    }
  }
  nominal.load_torque = std::abs(arm);
  nominal.load_angle_offset = std::arg(arm);
  return whole;
}

/// The drive of a scenario as a nominal model; what a load has beside arms and constants is taken for 0.
inline NominalModel exact_nominal(const Scenario& scenario) {
  const GearMesh<double> mesh = make_mesh(scenario);
  NominalModel exact{mesh.C1(), mesh.C2(), mesh.Jw * mesh.i, total_gear_inertia(scenario)};
  if (const auto* arm = std::get_if<GravityArm>(&scenario.load)) {
    exact.load_torque = arm->torque_amplitude();
    exact.load_angle_offset = arm->offset;
  } else if (const auto* signal = std::get_if<Signal>(&scenario.load)) {
    exact.load_constant = constant_torque(*signal).value_or(0.0);
  } else if (const auto* sum = std::get_if<LoadSum>(&scenario.load)) {
    add_to_nominal(*sum, exact);
  }
  if (const auto& magnitude = std::get<std::optional<LoadMagnitude<double>>>(scenario.effects.list)) {
    exact.load_torque *= 1.0 + magnitude->share;
    exact.load_constant *= 1.0 + magnitude->share;
  }
  if (const auto& angle = std::get<std::optional<LoadAngle<double>>>(scenario.effects.list))
    exact.load_angle_offset += angle->shift;
  return exact;
}

/// A scenario as the nominal drive: what effects add is what its controller does not know.
inline Scenario without_effects(Scenario scenario) {
  scenario.effects = {};
  return scenario;
}

/// What the controller believes: as stated, else what mesh and load state.
inline NominalModel make_nominal(const Scenario& scenario) {
  return completed(scenario.control->nominal, exact_nominal(without_effects(scenario)));
}
inline Variations make_variations(const Scenario& scenario) {
  return in_terms_of_C(scenario.control->variations, stated_mesh(scenario));
}

/// Whether the load is one that a nominal model can describe.
inline bool is_estimable(const Scenario& scenario) {
  if (std::get<std::optional<LoadSpring<double>>>(scenario.effects.list)) return false;
  if (const auto* sum = std::get_if<LoadSum>(&scenario.load)) {
    NominalModel nominal;
    return add_to_nominal(*sum, nominal);
  }
  const auto* signal = std::get_if<Signal>(&scenario.load);
  return std::holds_alternative<GravityArm>(scenario.load) || (signal && constant_torque(*signal));
}

/// Largest |tau_l - tau_l_hat| [N m] over all angles; unknown, infinity, for a load that no nominal model describes.
inline double largest_load_error(const Scenario& scenario) {
  if (!is_estimable(scenario)) return std::numeric_limits<double>::infinity();
  const NominalModel exact = exact_nominal(scenario), nominal = make_nominal(scenario);
  const auto arm = [](const NominalModel& n) {
    const auto [sine, cosine] = sine_and_cosine(n.load_angle_offset);
    return std::complex<double>(cosine, sine) * n.load_torque;
  };
  return std::abs(arm(exact) - arm(nominal)) + std::abs(exact.load_constant - nominal.load_constant);
}

/// The numbers of Lemma 1 for a scenario whose controller has them.
inline Lemma1 make_lemma1(const Scenario& scenario) {
  return lemma1(make_nominal(scenario), make_variations(scenario));
}

/// Every condition of Lemma 1: on the law's numbers, then on the drive; none for other controllers.
inline std::vector<Condition> lemma1_conditions(const Scenario& scenario) {
  if (!scenario.control) return {};
  const auto* const law = std::get_if<SlidingParameters>(&scenario.control->law);
  if (!law) return {};
  std::vector<Condition> list = conditions(*law, make_lemma1(scenario));
  const std::vector<Condition> drive = conditions_on_drive(make_nominal(scenario), make_variations(scenario),
                                                           exact_nominal(scenario), largest_load_error(scenario));
  list.insert(list.end(), drive.begin(), drive.end());
  return list;
}

}  // namespace wormdrive
