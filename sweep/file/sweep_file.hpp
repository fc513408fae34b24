#pragma once
#include <algorithm>
#include <chrono>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "output/hdf5/fixed_table.hpp"
#include "output/hdf5/part_file.hpp"
#include "sweep/file/check_sweep.hpp"
#include "sweep/file/origin.hpp"
#include "sweep/file/reason_table.hpp"
#include "sweep/study/study.hpp"
#include "sweep/trial.hpp"
#include "sweep/trial_range.hpp"
#include "sweep/verdict.hpp"

namespace wormdrive {

class SweepReader;

/// Trials one after the other that a file has.
struct SweepPiece {
  TrialRange range;
  const SweepReader* file;
};

/// How long a row that is done waits at most until it is written.
inline constexpr std::chrono::milliseconds longest_wait(500);

/// The columns of the table /trials.
std::vector<ColumnDescription> trial_columns(const Study& study);
/// The columns of the table /referee: verdicts one after the other; a row of zeros is none.
std::vector<ColumnDescription> verdict_columns(Axis axis);

/// The HDF5 file of a sweep, written while it goes on; see output/schema.md. It stays as NAME.part whatever happens, so
/// that the sweep can be resumed. Who makes NAME holds its OutputLock meanwhile.
class SweepFile {
 public:
  /// Leaves an empty NAME.part that has room for the trials of a range, all of the study or those of a shard.
  static void create(const std::string& path, const Study& study, TrialRange range, const std::string& command_line,
                     Replace replace = Replace::same_kind);
  /// Opens NAME.part, to write the trials that it lacks. reasons: those of the trials that it has.
  SweepFile(const std::string& path, const Study& study, TrialRange range, ReasonTable reasons = {},
            Replace replace = Replace::same_kind);

  /// Takes a trial of the range, in any order.
  void append(Trial trial);
  /// Takes trials from other files of the same study, in the order of the trials, column by column.
  void copy(std::span<const SweepPiece> pieces);
  /// Writes what has waited for half a second: called often enough, it leaves nothing older than a second that would be
  /// lost if the program dies.
  void keep_safe();
  /// Makes all trials safe.
  void flush();
  /// Drops every trial from this one on.
  void drop_from(std::uint64_t trial);
  /// Drops every trial from this one on, and lets the file be complete without them.
  void end_before(std::uint64_t trial);
  /// Writes what a referee found.
  void write(const std::vector<RefereeVerdict>& verdicts);
  /// Sums up the trials in /summary and gives the file its final name. Where it ends early, or where trials came in
  /// another order than that of their indices, and kinds of reasons with them, the file is written once more, in order.
  void finish();

  const std::string& part_path() const { return file_.part_path(); }

 private:
  using Clock = std::chrono::steady_clock;

  /// Writes some trials one after the other, all but how they ended, or that alone.
  enum class Part { all_but_status, status };
  void write(std::span<const Trial> trials, Part part);
  /// Numbers of reasons, one trial after the other, as they are in this file.
  std::vector<double> recoded(std::vector<double> codes, const std::vector<std::string>& reasons, std::uint64_t first);
  void write_reasons();
  /// What has been written is on the disk: from then on it may have a status.
  void make_safe();
  void finish_in_order();

  Axis axis_;
  TrialRange range_;
  PartFile file_;
  std::optional<FixedTable> table_;
  std::optional<FixedTexts> reason_texts_;
  std::size_t columns_;
  std::vector<Trial> waiting_;  ///< trials that are not in the table yet
  ReasonTable reasons_;
  std::vector<std::string> reasons_written_;
  bool ends_early_ = false;  ///< the table has room for trials that are not to come
  Clock::time_point flushed_;
};

/// A sweep file, complete or NAME.part, read back.
class SweepReader {
 public:
  /// Throws InputFault if it cannot be read or is no sweep. while_written: another program may be writing trials in it;
  /// those that it has by now can be read.
  explicit SweepReader(const std::string& path, bool while_written = false);

  const std::string& path() const { return path_; }
  const Study& study() const { return study_; }
  /// As it was typed to begin the sweep.
  std::string command_line() const { return read_text_attribute(file_, "command_line"); }
  /// The trials for which it has room.
  TrialRange range() const { return stored_->range; }
  /// The trials that it has, in rising order.
  const std::vector<TrialRange>& present() const { return present_; }
  std::uint64_t trials() const { return trials_in(present_); }
  bool has(std::uint64_t trial) const;
  bool complete() const { return trials() == range().size(); }

  /// Why rows of the two cannot stand in one sweep: the study, its scenario or the program differ. Empty if they can.
  std::string why_not_of(const Study& study) const;
  std::string why_not_of(const SweepReader& other) const;

  /// Trials one after the other: which is the first, how they ended (0: it is missing), and some of their columns.
  struct Block {
    std::uint64_t first;
    std::vector<double> status;
    std::vector<std::vector<double>> columns;
  };
  /// Calls visit for blocks of some trials, so large that memory does not grow with their number.
  void for_each_block(TrialRange range, const std::vector<std::string>& columns,
                      const std::function<void(const Block&)>& visit) const;
  /// The same of the whole range.
  void for_each_block(const std::vector<std::string>& columns, const std::function<void(const Block&)>& visit) const {
    for_each_block(range(), columns, visit);
  }
  /// The same of one column alone: calls visit with the first trial and the values.
  void for_each_block(TrialRange range, const std::string& column,
                      const std::function<void(std::uint64_t, const std::vector<double>&)>& visit) const;
  /// Trials that are all present.
  std::vector<Trial> read(TrialRange range) const;
  const std::vector<std::string>& reasons() const { return reasons_; }
  std::vector<RefereeVerdict> verdicts() const;
  /// The reasons of the trials that it has, counted.
  ReasonTable counted_reasons() const;

 private:
  std::string path_;
  Hdf5Handle file_;
  Study study_;
  Origin origin_;
  std::optional<StoredTrials> stored_;  ///< there once the file is found good
  std::vector<TrialRange> present_;
  std::vector<std::string> reasons_;
};

/// Calls visit(trial) for trials of a sweep that are all present, without holding them all.
template <class Visit>
void for_each_trial(const SweepReader& sweep, TrialRange range, Visit&& visit) {
  constexpr std::uint64_t at_once = 4096;
  for (std::uint64_t first = range.first; first < range.end; first += at_once)
    for (Trial& trial : sweep.read({first, std::min(first + at_once, range.end)})) visit(std::move(trial));
}

}  // namespace wormdrive
