#include "statistics/parallel.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace wormdrive {

namespace {

/// Threads that the outermost loop of this thread may still start, for itself and for loops within its tasks.
thread_local std::atomic<int>* spare = nullptr;

/// Takes up to so many of the spare threads.
int taken(std::atomic<int>& from, std::size_t most) {
  int there = from.load(), take = 0;
  do take = std::clamp(there, 0, static_cast<int>(most));
  while (take > 0 && !from.compare_exchange_weak(there, there - take));
  return take;
}

}  // namespace

void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& task) {
  if (count == 0) return;
  std::atomic<int> own{threads - 1};
  std::atomic<int>* const outer = spare;
  std::atomic<int>& free = outer ? *outer : own;
  std::atomic<std::size_t> next{0};
  std::exception_ptr fault;
  std::mutex guard;
  const auto work = [&] {
    spare = &free;
    for (std::size_t k = next++; k < count; k = next++) {
      try {
        task(k);
      } catch (...) {
        const std::lock_guard lock(guard);
        if (!fault) fault = std::current_exception();
      }
    }
    ++free;  // for a loop within a task that is not done yet
  };
  std::vector<std::thread> helpers;
  for (int k = taken(free, count - 1); k > 0; --k) helpers.emplace_back(work);
  work();
  for (std::thread& t : helpers) t.join();
  --free;  // of this thread itself, which goes on
  spare = outer;
  if (fault) std::rethrow_exception(fault);
}

}  // namespace wormdrive
