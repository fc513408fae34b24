#include "events/sensitivity/sensitivity.hpp"

namespace wormdrive {

WORMDRIVE_SENSITIVITIES(, TimedLoad)
WORMDRIVE_SENSITIVITIES(, GravityLoad)
WORMDRIVE_SENSITIVITIES(, SummedLoad)

}  // namespace wormdrive
