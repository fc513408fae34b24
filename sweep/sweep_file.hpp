#pragma once
#include <algorithm>
#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "output/fixed_table.hpp"
#include "output/part_file.hpp"
#include "sweep/study.hpp"
#include "sweep/trial.hpp"
#include "sweep/trial_range.hpp"
#include "sweep/verdict.hpp"

namespace wormdrive {

/// Numbers the kinds of reasons for which trials are not done, as they occur; few enough to be kept in memory.
class ReasonTable {
 public:
  static constexpr std::size_t most = 100;

  ReasonTable() = default;
  /// Goes on with kinds that have their numbers already; counts: of each of them.
  ReasonTable(const std::vector<std::string>& examples, const std::vector<std::uint64_t>& counts);

  /// Counts a reason and returns its number, 0 for a trial that is done; kinds beyond the last number share it.
  std::size_t code(const std::string& reason);
  struct Entry {
    std::string example;  ///< the first reason of its kind
    std::uint64_t count = 0;
  };
  /// Every kind, number 1 first.
  const std::vector<Entry>& entries() const { return entries_; }
  /// How many trials are not done.
  std::uint64_t total() const;

 private:
  std::map<std::string, std::size_t> codes_;  ///< by kind
  std::vector<Entry> entries_;
};

/// The columns of the table /trials.
std::vector<ColumnDescription> trial_columns(const Study& study);

/// The HDF5 file of a sweep, written while it goes on; see output/schema.md. It stays as NAME.part whatever happens, so
/// that the sweep can be resumed.
class SweepFile {
 public:
  /// Leaves an empty NAME.part that has room for the trials of a range, all of the study or those of a shard.
  static void create(const std::string& path, const Study& study, TrialRange range, const std::string& command_line);
  /// Opens NAME.part, to write the trials that it lacks. reasons: those of the trials that it has.
  SweepFile(const std::string& path, const Study& study, TrialRange range, ReasonTable reasons = {});

  /// Writes a trial of the range; what is older than a second is safe if the program dies.
  void append(const Trial& trial);
  /// Makes all trials safe.
  void flush();
  /// Writes what a referee found.
  void write(const std::vector<RefereeVerdict>& verdicts);
  /// Sums up the trials in /summary and gives the file its final name.
  void finish();

  const std::string& part_path() const { return file_.part_path(); }
  const ReasonTable& reasons() const { return reasons_; }

 private:
  using Clock = std::chrono::steady_clock;

  TrialRange range_;
  PartFile file_;
  std::optional<FixedTable> table_;
  std::optional<FixedTexts> reason_texts_;
  std::vector<std::vector<double>> columns_;  ///< of trials one after the other that are not in the table yet
  std::uint64_t row_ = 0;                     ///< of the first of these
  ReasonTable reasons_;
  std::size_t reasons_written_ = 0;
  Clock::time_point flushed_;
};

/// A sweep file, complete or NAME.part, read back.
class SweepReader {
 public:
  /// Throws InputFault if it cannot be read or is no sweep.
  explicit SweepReader(const std::string& path);

  const std::string& path() const { return path_; }
  const Study& study() const { return study_; }
  /// The trials for which it has room.
  TrialRange range() const { return range_; }
  /// The trials that it has, in rising order.
  const std::vector<TrialRange>& present() const { return present_; }
  std::uint64_t trials() const { return trials_in(present_); }
  bool has(std::uint64_t trial) const;
  bool complete() const { return trials() == range_.size(); }

  /// Why rows of the two cannot stand in one sweep: the study, its scenario or the program differ. Empty if they can.
  std::string why_not_of(const Study& study) const;
  std::string why_not_of(const SweepReader& other) const;

  /// Trials one after the other: which is the first, how they ended (0: it is missing), and some of their columns.
  struct Block {
    std::uint64_t first;
    std::vector<double> status;
    std::vector<std::vector<double>> columns;
  };
  /// Calls visit for blocks of the whole range, so large that memory does not grow with it.
  void for_each_block(const std::vector<std::string>& columns, const std::function<void(const Block&)>& visit) const;
  /// Trials that are all present.
  std::vector<Trial> read(TrialRange range) const;
  const std::vector<std::string>& reasons() const { return reasons_; }
  std::vector<RefereeVerdict> verdicts() const;
  /// The reasons of the trials that it has, counted.
  ReasonTable counted_reasons() const;

 private:
  std::string why_not(const std::string& study, const std::string& scenario, const std::string& build) const;

  std::string path_;
  Hdf5Handle file_;
  Study study_;
  std::string scenario_, build_;
  TrialRange range_;
  std::vector<TrialRange> present_;
  std::vector<std::string> reasons_;
};

/// Calls visit(trial) for trials of a sweep that are all present, without holding them all.
template <class Visit>
void for_each_trial(const SweepReader& sweep, TrialRange range, Visit&& visit) {
  constexpr std::uint64_t at_once = 4096;
  for (std::uint64_t first = range.first; first < range.end; first += at_once)
    for (const Trial& trial : sweep.read({first, std::min(first + at_once, range.end)})) visit(trial);
}

}  // namespace wormdrive
