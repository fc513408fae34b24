#include "description/warnings.hpp"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "core/elastic/elastic_teeth.hpp"
#include "description/build_control.hpp"
#include "description/keys.hpp"

namespace wormdrive {
namespace {

constexpr double closing_tolerance = 1e-3;  ///< data sheets round; beyond this the power balance suffers visibly

/// About the controller.
std::vector<std::string> control_warnings(const Scenario& scenario) {
  std::vector<std::string> list;
  if (!scenario.control) return list;
  const NominalSettings& stated = scenario.control->nominal;
  if (has_model(scenario.control->law) && !is_estimable(scenario) && !stated.load_torque && !stated.load_constant)
    list.push_back(sum_of(scenario.load).terms.size() > 1
                       ? "the controller knows arms and constants of the load only; state [controller.nominal]"
                       : "the controller assumes no load because the load is neither an arm nor a constant; state "
                         "[controller.nominal]");
  std::string failing;
  for (const Condition& c : lemma1_conditions(scenario))
    if (!c.holds()) failing += fmt::format("{}{}", failing.empty() ? "" : "; ", c.rule);
  if (!failing.empty())
    list.push_back(fmt::format("Lemma 1 does not hold (wormdrive check prints the details): {}", failing));
  return list;
}

/// A diagnosis finds such friction where something else than the bearings has the rest of it, as the teeth.
bool bearings_drive(const Effects<double>& effects) {
  const auto& asymmetry = std::get<std::optional<BearingAsymmetry<double>>>(effects.list);
  const auto& viscous = std::get<std::optional<WormViscous<double>>>(effects.list);
  return asymmetry && std::abs(asymmetry->coefficient) > (viscous ? viscous->coefficient : 0.0);
}

/// How warm a gearbox may become until its gear no longer locks itself [K]; nothing where it always does, or never.
std::optional<double> locks_up_to(const Scenario& scenario, const GearMesh<double>& mesh) {
  const auto& heat = std::get<std::optional<GearboxHeat<double>>>(scenario.effects.list);
  if (!heat || heat->friction_decay == 0.0 || mesh.mu < mesh.mu_w()) return std::nullopt;
  return heat->starting_rise + std::log(mesh.mu / mesh.mu_w()) / heat->friction_decay;
}

}  // namespace

std::vector<std::string> warnings(const Scenario& scenario, MotorTorque torque) {
  std::vector<std::string> list;
  const GearMesh<double> mesh = make_mesh(scenario);
  if (mesh.has_teeth && std::abs(mesh.closing_ratio() / mesh.i - 1.0) > closing_tolerance)
    list.push_back(
        fmt::format("geometry does not close: lg/(lw tan lambda) = {:.2f} but ratio = {:g}; lead_angle_deg = "
                    "{:.4f} would close it{}",
                    mesh.closing_ratio(), mesh.i, mesh.closing_lead_angle() / unit::degree,
                    has_elastic_teeth(scenario.effects) ? "; the flanks follow the ratio" : ""));
  if (torque == MotorTorque::stated && scenario.motor.terms.empty() && !scenario.control)
    list.push_back(
        fmt::format("no [motor.torque]: the motor {} is 0 throughout", in_words_of(scenario.axis, "torque")));
  if (bearings_drive(scenario.effects))
    list.push_back(
        "effect.bearing_asymmetry has a coefficient greater than that of worm_viscous: in one direction the "
        "bearings drive the worm");
  if (const auto rise = locks_up_to(scenario, mesh))
    list.push_back(
        fmt::format("the gear locks itself only while the gearbox is less than {:.3g} K warmer than its surroundings: "
                    "then friction falls below mu_w = {:.4g}",
                    *rise, mesh.mu_w()));
  for (const std::string& warning : control_warnings(scenario)) list.push_back(warning);
  return list;
}

}  // namespace wormdrive
