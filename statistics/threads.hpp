#pragma once
#include <algorithm>
#include <stdexcept>
#include <thread>

#include <fmt/format.h>

namespace wormdrive {

inline constexpr unsigned most_threads = 4096;  ///< that anybody may ask for: more than any machine runs at once

/// As many threads as are asked for, or for 0 as the machine has. Throws std::invalid_argument for more than there may
/// be.
inline unsigned threads_for(unsigned asked) {
  if (asked > most_threads)
    throw std::invalid_argument(fmt::format("threads = {} must be at most {}", asked, most_threads));
  return asked > 0 ? asked : std::max(1U, std::thread::hardware_concurrency());
}

}  // namespace wormdrive
