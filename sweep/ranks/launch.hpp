#pragma once
#include <string>

namespace wormdrive {

/// What the environment says of the processes with which this one was started.
struct Launch {
  std::string by = "mpirun";  ///< or "srun"
  long size = 1;              ///< how many; 0: several perhaps, and only MPI knows
  long rank = 0;
  bool can_meet = true;  ///< whether the launcher has told them how to find each other
};
Launch launch();

}  // namespace wormdrive
