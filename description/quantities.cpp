#include "description/quantities.hpp"

#include <cmath>
#include <numbers>
#include <type_traits>

#include <fmt/format.h>

#include "core/elastic/elastic_teeth.hpp"
#include "core/elastic/impact.hpp"
#include "core/energy.hpp"
#include "core/statics.hpp"
#include "description/build_control.hpp"
#include "description/keys.hpp"
#include "description/tables.hpp"

namespace wormdrive {
namespace {

template <class Parameters>
void list_fields(const Parameters& parameters, const std::string& path, Axis axis, std::vector<Quantity>& list) {
  for_each_field<Parameters>([&](const auto& field) {
    const std::optional<double> value = parameters.*field.member;
    if (!value || !std::isfinite(*value)) return;  // unlimited: nothing to show
    const Spelling s = spellings(field.name, field.unit, axis).front();
    list.push_back(
        {path + "." + s.key, std::string(s.unit.symbol), in_words_of(axis, field.meaning), *value / s.unit.si});
  });
}

}  // namespace

TeethNumbers teeth_numbers(const Scenario& scenario) {
  const GearMesh<double> mesh = make_mesh(scenario);
  const ToothContact<double> contact = tooth_contact(scenario.effects);
  const double mass = effective_mass(mesh, total_gear_inertia(scenario)), omega = contact_frequency(contact, mass);
  return {omega / (2.0 * std::numbers::pi), std::numbers::pi / omega, contact.backlash * mesh.gear_arm(0.0),
          restitution(contact, mass, 0.1)};
}

std::vector<Quantity> parameters(const Scenario& scenario) {
  std::vector<Quantity> list;
  for_each_table(scenario, [&]<class Parameters>(const TablePlace& place, const Parameters& p) {
    const auto points = [&](std::size_t count, std::string meaning) {
      list.push_back({place.path(), "1", std::move(meaning), static_cast<double>(count)});
    };
    if constexpr (std::is_same_v<Parameters, NominalSettings>) {
      const NominalModel n = make_nominal(scenario);
      list_fields(NominalSettings{n.C1, n.C2, n.Jw_i, n.Jg, n.load_torque, n.load_angle_offset, n.load_constant},
                  place.path(), scenario.axis, list);
    } else if constexpr (std::is_same_v<Parameters, DisturbanceSettings>) {
      if (p.deviation > 0.0) list_fields(p, place.path(), scenario.axis, list);
    } else if constexpr (requires { p.fields(); }) {
      list_fields(p, place.path(), scenario.axis, list);
    } else if constexpr (requires { p.times; }) {
      points(p.times.size(), "samples");
    }
    if constexpr (requires { p.table; }) points(p.table.points().size(), "points of the table");
  });
  return list;
}

std::vector<Quantity> derived(const Scenario& scenario) {
  const GearMesh<double> mesh = make_mesh(scenario);
  const double Jg = greatest_gear_inertia(scenario);
  if (!mesh.has_teeth) return {};
  const double slope = scenario.effects.least_slope(), surface = mesh.Jw * mesh.i * slope * slope / Jg;
  const char* const meaning_of_Jg =
      scenario.effects.twisting_coupling() ? "inertia of the gear side in front of the coupling"
      : Jg > total_gear_inertia(scenario)  ? "inertia of the gear side with the load, where it is greatest"
                                           : "inertia of the gear side with the load";
  std::vector<Quantity> list{
      {"C1", "1", "C(+mu), gear torque ratio where friction helps the worm", mesh.C1()},
      {"C2", "1", "C(-mu), gear torque ratio where friction hinders the worm", mesh.C2()},
      {"H", "1", "slope of the static surface tau_m = H tau_l", mesh.H()},
      {"mu_w", "1", "friction from which the gear cannot drive the worm", mesh.mu_w()},
      {"mu_g", "1", "friction from which the worm cannot drive the gear", mesh.mu_g()},
      {"Jg", "kg m^2", meaning_of_Jg, Jg},
      {"Jw i/Jg", "1", "slope of the switching surface tau_m = (Jw i/Jg) tau_l", mesh.Jw * mesh.i / Jg},
      {slope < 1.0 ? "C1 + Jw i k^2/Jg" : "C1 + Jw i/Jg", "1",
       slope < 1.0 ? "eq. 17 holds while it is positive; k: slope of the worm angle where the worm is slowest"
                   : "eq. 17 holds while it is positive",
       mesh.C1() + surface},
      {"efficiency forward", "1", "1/(i C2), worm drives", forward_efficiency(mesh)},
      {"efficiency backward", "1", "i C1, gear drives; negative when self-locking", backward_efficiency(mesh)}};
  if (has_elastic_teeth(scenario.effects)) {
    const TeethNumbers teeth = teeth_numbers(scenario);
    list.push_back(
        {"contact frequency", "Hz", "at which worm and gear oscillate while their teeth touch", teeth.frequency});
    list.push_back({"contact time", "ms", "of an impact without damping, half a period", 1e3 * teeth.contact});
    list.push_back({"gap", "um", "between the flanks along their normal", 1e6 * teeth.gap});
    list.push_back(
        {"restitution", "1", "separation speed over approach speed of an impact at 0.1 m/s", teeth.restitution});
  }
  return list;
}

}  // namespace wormdrive
