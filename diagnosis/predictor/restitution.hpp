#pragma once

namespace wormdrive {

/// How teeth that meet across a gap part again.
struct Restitution {
  double restitution = 0.6;  ///< speed at which they part over that at which they met
  double duration = 1e-3;    ///< of an impact [s]
};

}  // namespace wormdrive
