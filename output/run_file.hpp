#pragma once
#include <optional>
#include <string>
#include <vector>

#include "events/solver_settings.hpp"
#include "output/part_file.hpp"
#include "output/table.hpp"
#include "output/trajectory.hpp"

namespace wormdrive {

/// Units of a rotary drive or of a linear axis (m, N, kg).
enum class Axis { rotary, linear };

/// The HDF5 file of a run, written while it goes on; see output/schema.md.
class RunFile {
 public:
  RunFile(const std::string& path, const Provenance& provenance, Axis axis);

  /// Appends rows and events and makes them safe.
  void append(const Trajectory& part);
  /// Writes the statistics and gives the file its final name.
  void finish(const std::string& solver, const SolverStatistics& statistics);

  PartFile& file() { return file_; }

 private:
  PartFile file_;
  std::optional<GrowingTable> trajectory_, events_;
};

/// What can be read back from a run file.
struct StoredRun {
  std::string title, kind, scenario;
};
/// Reads the attributes of a result file; throws OutputFault if it is not one.
StoredRun read_stored_run(const std::string& path);

/// Whether a file begins like an HDF5 file.
bool is_hdf5(const std::string& path);

}  // namespace wormdrive
