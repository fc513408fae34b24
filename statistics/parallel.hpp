#pragma once
#include <cstddef>
#include <functional>

namespace wormdrive {

/// Calls task(k) for k in [0, count) on up to `threads` threads. Loops within a task share these: they take those that
/// have nothing to do. The tasks must not depend on each other; the first exception is thrown again here.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& task);

}  // namespace wormdrive
