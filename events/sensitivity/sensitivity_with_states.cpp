#include "events/sensitivity/along_sequence.hpp"

namespace wormdrive {

template Sensitivities derivatives<true>(const EventSequence<StatedDrive<true>>&, const StatedDrive<true>&, double,
                                         const RigidDrive&, std::span<const Parameter>, const SolverSettings&);

}  // namespace wormdrive
