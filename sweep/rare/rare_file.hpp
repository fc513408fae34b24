#pragma once
#include <condition_variable>
#include <exception>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "output/hdf5/fixed_table.hpp"
#include "output/hdf5/part_file.hpp"
#include "sweep/rare/rare_event.hpp"

namespace wormdrive {

/// The HDF5 file of an estimate, see output/schema.md. While it is made, NAME.part keeps every run that has ended, a
/// second later at the latest, so that the estimate can be gone on with.
class RareFile {
 public:
  /// Opens NAME.part; with resume it goes on with what is there of the same study, settings and program, or reads NAME
  /// if that is complete. The settings name their metric. Throws InputFault where something else is there, and
  /// OutputFault where nothing can be written.
  RareFile(const std::string& path, const Study& study, const RareSettings& settings, const std::string& command_line,
           bool resume, Replace replace);
  ~RareFile();

  /// For the estimate: what is there, and a place for the rest.
  KeptRuns runs();
  /// How many runs were there from the start.
  std::uint64_t from_before() const { return from_before_; }
  /// Whether NAME had all of them.
  bool was_complete() const { return !file_; }
  /// Writes what came of the runs and gives the file its final name.
  void finish(const RareEvent& event);
  /// Where the study allows no estimate: leaves nothing behind but runs that were there before.
  void give_up();

 private:
  void keep(Trial trial);
  void flush();
  void keep_safe(const std::stop_token& stop);

  const Study& study_;
  std::string settings_, command_line_;
  OutputLock lock_;
  std::unique_ptr<PartFile> file_;  ///< none where NAME is complete
  std::optional<FixedTable> table_;
  std::map<std::uint64_t, Trial> made_;  ///< from before
  std::uint64_t from_before_ = 0;
  std::vector<Trial> waiting_, written_;  ///< runs that are not in the table yet, and that were not there before
  std::exception_ptr fault_;              ///< what writing met with
  std::mutex mutex_;
  std::condition_variable_any wakes_;
  std::jthread keeper_;  ///< writes what waits; the last member, for it uses the others
};

}  // namespace wormdrive
