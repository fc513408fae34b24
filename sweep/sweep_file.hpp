#pragma once
#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "output/part_file.hpp"
#include "output/table.hpp"
#include "sweep/ensemble.hpp"
#include "sweep/study.hpp"

namespace wormdrive {

/// Numbers the kinds of reasons for which trials are not done, as they occur; few enough to be kept in memory.
class ReasonTable {
 public:
  /// Counts a reason and returns its number, 0 for a trial that is done; kinds beyond the hundredth share the last
  /// number.
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

/// The HDF5 file of a sweep, written while it goes on; see output/schema.md. It stays as NAME.part whatever happens, so
/// that the sweep can be resumed.
class SweepFile {
 public:
  /// range: the trials that the file is to hold, all or those of a shard.
  SweepFile(const std::string& path, const Study& study, TrialRange range, const std::string& command_line);

  /// Appends the trial that follows the latest one; what is older than a second is safe if the program dies.
  void append(const Trial& trial);
  /// Makes all rows safe.
  void flush();
  /// Gives the file its final name.
  void finish();

  const std::string& part_path() const { return file_.part_path(); }
  /// Rows that were appended.
  std::uint64_t rows() const { return static_cast<std::uint64_t>(rows_) + columns_.front().size(); }
  const ReasonTable& reasons() const { return reasons_; }

 private:
  using Clock = std::chrono::steady_clock;

  PartFile file_;
  std::optional<GrowingTable> table_;
  std::vector<std::vector<double>> columns_;  ///< rows that are not in the table yet
  std::int64_t rows_ = 0;                     ///< in the table
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
  TrialRange range() const { return range_; }
  /// Rows that are there for certain.
  std::uint64_t rows() const { return rows_; }
  bool complete() const { return rows_ == range_.size(); }

  /// Why rows of the two cannot stand in one sweep: the study, its scenario or the program differ. Empty if they can.
  std::string why_not_of(const Study& study) const;
  std::string why_not_of(const SweepReader& other) const;

  std::vector<double> column(const std::string& name) const;
  /// So many trials from a row on.
  std::vector<Trial> read(std::uint64_t row, std::uint64_t count) const;
  const std::vector<std::string>& reasons() const { return reasons_; }

 private:
  std::string why_not(const std::string& study, const std::string& scenario, const std::string& build) const;

  std::string path_;
  Hdf5Handle file_;
  Study study_;
  std::string scenario_, build_;
  TrialRange range_;
  std::uint64_t rows_ = 0;
  std::vector<std::string> reasons_;
};

/// Appends all rows of a sweep to another one.
void copy_rows(const SweepReader& from, SweepFile& to);

}  // namespace wormdrive
