#pragma once
#include <algorithm>
#include <thread>

namespace wormdrive {

/// As many threads as are asked for, or for 0 as the machine has.
inline unsigned threads_for(unsigned asked) {
  return asked > 0 ? asked : std::max(1U, std::thread::hardware_concurrency());
}

}  // namespace wormdrive
