#include "sweep/ranks/ranks.hpp"

#include <chrono>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "description/diagnostics.hpp"
#include "sweep/ranks/launch.hpp"

#ifdef WORMDRIVE_MPI
#include <mpi.h>
#endif

namespace wormdrive {
namespace {

constexpr const char* each_its_shard = "give every process its own --shard";

/// Throws InputFault in the first process; in the others one that tells nothing.
[[noreturn]] void reject_launch(const Launch& launch, const std::string& what) {
  if (launch.rank == 0) reject({launch.by}, what);
  throw InputFault(std::vector<Fault>{});
}

}  // namespace

Tally Ranks::count_here(Tally more) {
  const std::lock_guard lock(mutex_);
  tally_.resize(more.size());
  for (std::size_t k = 0; k < more.size(); ++k) more[k] = std::exchange(tally_[k], tally_[k] + more[k]);
  return more;
}

#ifdef WORMDRIVE_MPI

/// MPI as several threads share it: it is called by one of them at a time, and none of them waits inside, for a message
/// of the others may be what all wait for. Between two looks they sleep, and leave the core to the trials.
struct Ranks::Link {
  enum Tag { question, answer };

  /// Waits for what begin(request) begins.
  template <class Begin>
  void complete(Begin&& begin) {
    MPI_Request request = MPI_REQUEST_NULL;
    {
      const std::lock_guard lock(calls);
      begin(&request);
    }
    for (int done = 0;;) {
      {
        const std::lock_guard lock(calls);
        MPI_Test(&request, &done, MPI_STATUS_IGNORE);
      }
      if (done) return;
      std::this_thread::sleep_for(std::chrono::microseconds(200));
    }
  }

  Tally ask(Tally more) {
    const std::lock_guard one_at_a_time(asking);
    const int size = static_cast<int>(more.size());
    complete([&](MPI_Request* request) {
      MPI_Isend(more.data(), size, MPI_UINT64_T, 0, question, MPI_COMM_WORLD, request);
    });
    complete(
        [&](MPI_Request* request) { MPI_Irecv(more.data(), size, MPI_UINT64_T, 0, answer, MPI_COMM_WORLD, request); });
    return more;
  }

  /// Whether somebody has asked, who then has been answered.
  bool answered(Ranks& ranks) {
    const std::lock_guard lock(calls);
    int asked = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, question, MPI_COMM_WORLD, &asked, &status);
    if (!asked) return false;
    int size = 0;
    MPI_Get_count(&status, MPI_UINT64_T, &size);
    Tally tally(static_cast<std::size_t>(size));
    MPI_Recv(tally.data(), size, MPI_UINT64_T, status.MPI_SOURCE, question, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    tally = ranks.count_here(std::move(tally));
    MPI_Send(tally.data(), size, MPI_UINT64_T, status.MPI_SOURCE, answer, MPI_COMM_WORLD);  // who asks waits for it
    return true;
  }
  void answer_until_stopped(Ranks& ranks) {
    answers = std::jthread([this, &ranks](const std::stop_token& stop) {
      while (!stop.stop_requested())
        if (!answered(ranks)) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    });
  }

  std::mutex calls, asking;
  std::jthread answers;  ///< of the first one
};

Ranks::Ranks(bool apart) {
  const Launch launched = launch();
  if (launched.size == 1) return;  // joining takes time, and a single process needs nobody
  if (apart && launched.by == "srun") return;
  if (!launched.can_meet)
    reject_launch(launched, fmt::format("has started {} processes that cannot find each other; start them with srun "
                                        "--mpi=pmix or with mpirun, or {}",
                                        launched.size, each_its_shard));
  int level = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &level);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &count_);
  std::string fault;
  if (launched.size > 0 && launched.size != count_) {
    char library[MPI_MAX_LIBRARY_VERSION_STRING] = {};
    int length = 0;
    MPI_Get_library_version(library, &length);
    const std::string name(library, static_cast<std::size_t>(length));
    fault = fmt::format(
        "has started {} processes, but MPI finds {}: it belongs to another MPI than the one wormdrive was "
        "built with, {}; start them with the mpirun of that MPI, or {}",
        launched.size, count_, name.substr(0, name.find_first_of(",\n")), each_its_shard);
  } else if (level < MPI_THREAD_SERIALIZED) {
    fault = fmt::format(
        "has started {} processes with an MPI without support for threads; build it with threads, or "
        "{}",
        count_, each_its_shard);
  }
  if (!fault.empty()) {
    MPI_Finalize();
    reject_launch(launched, fault);
  }
  if (count_ == 1) {
    MPI_Finalize();
    return;
  }
  link_ = std::make_unique<Link>();
  if (first()) link_->answer_until_stopped(*this);
}

Ranks::~Ranks() {
  if (!link_) return;
  link_->complete([](MPI_Request* request) { MPI_Ibarrier(MPI_COMM_WORLD, request); });  // nobody will ask any more
  if (first()) {
    link_->answers.request_stop();
    link_->answers.join();
  }
  MPI_Finalize();
}

std::vector<std::uint64_t> Ranks::told(std::vector<std::uint64_t> numbers) const {
  if (!link_) return numbers;
  const auto tell = [this](std::uint64_t* first, std::size_t count) {
    link_->complete([&](MPI_Request* request) {
      MPI_Ibcast(first, static_cast<int>(count), MPI_UINT64_T, 0, MPI_COMM_WORLD, request);
    });
  };
  std::uint64_t size = numbers.size();
  tell(&size, 1);
  numbers.resize(size);
  tell(numbers.data(), size);
  return numbers;
}

std::uint64_t Ranks::sum(std::uint64_t number) const {
  if (!link_) return number;
  std::uint64_t all = 0;
  link_->complete(
      [&](MPI_Request* request) { MPI_Iallreduce(&number, &all, 1, MPI_UINT64_T, MPI_SUM, MPI_COMM_WORLD, request); });
  return all;
}

Tally Ranks::add(Tally more) { return link_ && !first() ? link_->ask(std::move(more)) : count_here(std::move(more)); }

#else

struct Ranks::Link {};

Ranks::Ranks(bool apart) {
  const Launch launched = launch();
  if (launched.size <= 1 || (apart && launched.by == "srun")) return;
  reject_launch(launched,
                fmt::format("this wormdrive was built without MPI; install libopenmpi-dev and build it again, "
                            "or {}",
                            each_its_shard));
}
Ranks::~Ranks() = default;
std::vector<std::uint64_t> Ranks::told(std::vector<std::uint64_t> numbers) const { return numbers; }
std::uint64_t Ranks::sum(std::uint64_t number) const { return number; }
Tally Ranks::add(Tally more) { return count_here(std::move(more)); }

#endif

}  // namespace wormdrive
