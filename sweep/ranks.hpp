#pragma once
#include <array>
#include <cstdint>
#include <mutex>
#include <vector>

namespace wormdrive {

/// The processes that share a sweep, as mpirun has started them; a single one without mpirun, or where the program was
/// built without MPI.
class Ranks {
 public:
  /// Joins the others. Throws InputFault if mpirun has started several and the program knows no MPI.
  Ranks();
  Ranks(const Ranks&) = delete;
  ~Ranks();

  int rank() const { return rank_; }
  int count() const { return count_; }
  bool first() const { return rank_ == 0; }

  /// What the first one says, for all. All have to call it, as of those that follow.
  std::vector<std::uint64_t> told(std::vector<std::uint64_t> numbers) const;
  std::uint64_t sum(std::uint64_t number) const;

  /// Two counters that all share and that start at 0: which portion comes next, how many trials have failed.
  enum class Counter { portion, failures };
  /// Adds to a counter, one-sided: nobody waits for anybody. Returns what it was. Threads may call it.
  std::uint64_t add(Counter counter, std::uint64_t number);

 private:
  int rank_ = 0, count_ = 1;
  std::array<std::uint64_t, 2> counters_{};  ///< of the first one; nobody asks the others
  std::mutex mutex_;
  struct Window;
  Window* window_ = nullptr;  ///< none for a single process
};

}  // namespace wormdrive
