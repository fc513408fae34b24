#include "cli/describe_teeth.hpp"

#include <numbers>

#include <fmt/format.h>

#include "core/elastic_teeth.hpp"
#include "core/impact.hpp"
#include "scenarios/build.hpp"

namespace wormdrive {

TeethNumbers teeth_numbers(const Scenario& scenario) {
  const GearMesh<double> mesh = make_mesh(scenario);
  const ToothContact<double> contact = tooth_contact(scenario.effects);
  const double mass = effective_mass(mesh, total_gear_inertia(scenario)), omega = contact_frequency(contact, mass);
  return {omega / (2.0 * std::numbers::pi), std::numbers::pi / omega, contact.backlash * mesh.gear_arm(0.0),
          restitution(contact, mass, 0.1)};
}

std::string describe_teeth(const Scenario& scenario) {
  const TeethNumbers teeth = teeth_numbers(scenario);
  const ToothContact<double> contact = tooth_contact(scenario.effects);
  return fmt::format(
      "elastic: worm and gear are two inertias (compliant drive); {:g} N/m, contact at {:.4g} Hz; gap "
      "{:.4g} deg or {:.4g} um; restitution {:.3f} at 0.1 m/s",
      contact.stiffness(), teeth.frequency, contact.backlash / unit::degree, 1e6 * teeth.gap, teeth.restitution);
}

}  // namespace wormdrive
