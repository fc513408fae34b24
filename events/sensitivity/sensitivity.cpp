#include "events/sensitivity/sensitivity.hpp"

#include "core/load.hpp"

namespace wormdrive {

WORMDRIVE_SENSITIVITIES(, TimedLoad)
WORMDRIVE_SENSITIVITIES(, GravityLoad)
WORMDRIVE_SENSITIVITIES(, TableLoad)

}  // namespace wormdrive
