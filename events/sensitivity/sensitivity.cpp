#include "events/sensitivity/sensitivity.hpp"

#include "events/sensitivity/along_sequence.hpp"

namespace wormdrive {

template Sensitivities derivatives<false>(const EventSequence<StatedDrive<false>>&, const StatedDrive<false>&, double,
                                          const RigidDrive&, std::span<const Parameter>, const SolverSettings&);

Sensitivities sensitivities(const RigidDrive& parts, std::span<const Parameter> parameters, const Timetable& timetable,
                            const SolverSettings& settings) {
  NoController nobody;
  return sensitivities(parts, parameters, timetable, settings, nobody);
}

}  // namespace wormdrive
