#include "events/sensitivity/sensitivity.hpp"

#include "events/sensitivity/along_sequence.hpp"

namespace wormdrive {

Sensitivities sensitivities(const RigidDrive& parts, std::span<const Parameter> parameters, const Timetable& timetable,
                            const SolverSettings& settings, const HeldTorque& held) {
  return parts.effects.have_states() ? sensitivities_of<true>(parts, parameters, timetable, settings, held)
                                     : sensitivities_of<false>(parts, parameters, timetable, settings, held);
}

}  // namespace wormdrive
