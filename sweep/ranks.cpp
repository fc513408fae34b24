#include "sweep/ranks.hpp"

#include <cstdlib>
#include <utility>

#include "scenarios/faults.hpp"

#ifdef WORMDRIVE_MPI
#include <mpi.h>
#endif

namespace wormdrive {
namespace {

/// How many processes a launcher says that it has started; 1 without one.
long launched() {
  for (const char* const variable : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "MV2_COMM_WORLD_SIZE"})
    if (const char* const size = std::getenv(variable)) return std::strtol(size, nullptr, 10);
  return 1;
}

}  // namespace

#ifdef WORMDRIVE_MPI

struct Ranks::Window {
  MPI_Win handle{};
};

Ranks::Ranks() {
  if (launched() <= 1) return;  // joining takes time, and a single process needs nobody
  int level = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &level);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
  window_ = new Window;
  MPI_Win_create(counters_.data(), sizeof counters_, sizeof(std::uint64_t), MPI_INFO_NULL, MPI_COMM_WORLD,
                 &window_->handle);
}

Ranks::~Ranks() {
  if (!window_) return;
  MPI_Win_free(&window_->handle);
  delete window_;
  MPI_Finalize();
}

std::vector<std::uint64_t> Ranks::told(std::vector<std::uint64_t> numbers) const {
  if (!window_) return numbers;
  std::uint64_t size = numbers.size();
  MPI_Bcast(&size, 1, MPI_UINT64_T, 0, MPI_COMM_WORLD);
  numbers.resize(size);
  MPI_Bcast(numbers.data(), static_cast<int>(size), MPI_UINT64_T, 0, MPI_COMM_WORLD);
  return numbers;
}

std::uint64_t Ranks::sum(std::uint64_t number) const {
  if (window_) MPI_Allreduce(MPI_IN_PLACE, &number, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD);
  return number;
}

std::uint64_t Ranks::add(Counter counter, std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  std::uint64_t& here = counters_[static_cast<std::size_t>(counter)];
  if (!window_) return std::exchange(here, here + number);
  std::uint64_t before = 0;
  MPI_Win_lock(MPI_LOCK_SHARED, 0, 0, window_->handle);
  MPI_Fetch_and_op(&number, &before, MPI_UINT64_T, 0, static_cast<MPI_Aint>(counter), MPI_SUM, window_->handle);
  MPI_Win_unlock(0, window_->handle);
  return before;
}

#else

struct Ranks::Window {};

Ranks::Ranks() {
  if (launched() > 1)
    refuse({"mpirun"},
           "this wormdrive was built without MPI; install libopenmpi-dev and build it again, or give every "
           "process a --shard of its own");
}
Ranks::~Ranks() = default;
std::vector<std::uint64_t> Ranks::told(std::vector<std::uint64_t> numbers) const { return numbers; }
std::uint64_t Ranks::sum(std::uint64_t number) const { return number; }
std::uint64_t Ranks::add(Counter counter, std::uint64_t number) {
  const std::lock_guard lock(mutex_);
  std::uint64_t& here = counters_[static_cast<std::size_t>(counter)];
  return std::exchange(here, here + number);
}

#endif

}  // namespace wormdrive
