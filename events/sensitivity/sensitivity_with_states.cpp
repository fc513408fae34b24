#include "events/sensitivity/along_sequence.hpp"

namespace wormdrive {

template Sensitivities sensitivities_of<true>(const RigidDrive&, std::span<const Parameter>, const Timetable&,
                                              const SolverSettings&, const HeldTorque&);

}  // namespace wormdrive
