#include "cli/describe/teeth.hpp"

#include <fmt/format.h>

#include "core/elastic/elastic_teeth.hpp"
#include "description/quantities.hpp"

namespace wormdrive {

std::string describe_teeth(const Scenario& scenario) {
  const TeethNumbers teeth = teeth_numbers(scenario);
  const ToothContact<double> contact = tooth_contact(scenario.effects);
  return fmt::format(
      "elastic: worm and gear are two inertias (compliant drive); {:g} N/m, contact at {:.4g} Hz; gap "
      "{:.4g} deg or {:.4g} um; restitution {:.3f} at 0.1 m/s",
      contact.stiffness(), teeth.frequency, contact.backlash / unit::degree, 1e6 * teeth.gap, teeth.restitution);
}

}  // namespace wormdrive
