#pragma once
#include <functional>
#include <string>
#include <vector>

#include "output/hdf5/table.hpp"
#include "sweep/file/sweep_file.hpp"

namespace wormdrive {

/// The trials of a sweep in memory, column by column.
class SweepResult {
 public:
  explicit SweepResult(Study study);

  /// Makes all trials, on so many threads. between() is called after each, on the calling thread, and may throw.
  void run(unsigned threads, const std::function<void()>& between);

  /// Takes trials that were made before, column by column, with the reasons of those that were not done.
  void restore(std::vector<std::vector<double>> columns, const std::vector<std::string>& reasons);

  const Study& study() const { return study_; }
  /// As in the table /trials of a file.
  const std::vector<ColumnDescription>& columns() const { return descriptions_; }
  const std::vector<double>& column(std::size_t k) const { return values_[k]; }
  /// The k-th text is what k + 1 in the column `reason` stands for.
  std::vector<std::string> reasons() const;
  /// Writes the result file that `wormdrive sweep` would write; so many trials, chosen by the seed, CVODE makes again
  /// beforehand, as a referee, where it has not made them itself. Throws OutputFault.
  void write(const std::string& path, const std::string& command_line, std::size_t judged, unsigned threads,
             Replace replace) const;

 private:
  void take(const Trial& trial);
  void end_before(std::size_t row);
  Trial trial(std::size_t row) const;

  Study study_;
  std::vector<ColumnDescription> descriptions_;
  std::vector<std::vector<double>> values_;
  ReasonTable reasons_;
};

}  // namespace wormdrive
