#pragma once
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace wormdrive {

/// What ranks count together.
using Tally = std::vector<std::uint64_t>;

/// The processes that share a sweep, as mpirun or srun has started them; a single one without either, or where the
/// program was built without MPI.
class Ranks {
 public:
  /// Joins the others. apart: every process has trials of its own, so that those of srun need not know each other.
  /// Throws InputFault, of all the processes in the first one, if several were started that cannot find each other.
  explicit Ranks(bool apart);
  Ranks(const Ranks&) = delete;
  ~Ranks();

  int rank() const { return rank_; }
  int count() const { return count_; }
  bool first() const { return rank_ == 0; }

  /// What the first one says, for all. All have to call it, as of those that follow.
  std::vector<std::uint64_t> told(std::vector<std::uint64_t> numbers) const;
  std::uint64_t sum(std::uint64_t number) const;

  /// Adds numbers to what all have counted, which starts at 0, and returns what that was; always as many numbers.
  /// Nobody waits for anybody's trial: a thread of the first one answers. Threads may call it.
  Tally add(Tally more);

 private:
  Tally count_here(Tally more);

  int rank_ = 0, count_ = 1;
  Tally tally_;  ///< of the first one; nobody asks the others
  std::mutex mutex_;
  struct Link;
  std::unique_ptr<Link> link_;  ///< none for a single process
};

}  // namespace wormdrive
