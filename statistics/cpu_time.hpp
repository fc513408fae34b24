#pragma once
#include <ctime>

namespace wormdrive {

/// CPU time on a clock of POSIX [s].
inline double cpu_time_of(clockid_t clock) {
  timespec time{};
  clock_gettime(clock, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// That of this process, and of the calling thread [s].
inline double cpu_time() { return cpu_time_of(CLOCK_PROCESS_CPUTIME_ID); }
inline double thread_cpu_time() { return cpu_time_of(CLOCK_THREAD_CPUTIME_ID); }

}  // namespace wormdrive
