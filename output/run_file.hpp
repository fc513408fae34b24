#pragma once
#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "control/closed_loop.hpp"
#include "control/control_summary.hpp"
#include "core/axis.hpp"
#include "events/solver_settings.hpp"
#include "output/hdf5/part_file.hpp"
#include "output/hdf5/table.hpp"
#include "output/trajectory.hpp"

namespace wormdrive {

/// A state of an effect, as a column of a run.
struct StateColumn {
  ColumnDescription description;
  std::size_t state;  ///< its place among all
};

/// What a run shows beside the rigid drive.
struct RunContents {
  bool controlled = false;  ///< there will be samples of a controller
  bool elastic = false;     ///< worm and gear move on their own
  bool winding = false;     ///< the motor has one
  bool stops = false;       ///< the gear can hit hard ones
  std::vector<StateColumn> states{};
  std::uint64_t expected_rows = 0;  ///< about how many
};

/// The HDF5 file of a run, written while it goes on; see output/schema.md.
class RunFile {
 public:
  RunFile(const std::string& path, const Provenance& provenance, Axis axis, RunContents contents = {},
          Replace replace = Replace::same_kind);

  /// Appends rows and events; what is older than a second is safe if the program dies.
  void append(const Trajectory& part);
  /// Appends samples of the controller.
  void append(const std::vector<ControlRecord>& samples);
  /// Writes how well the controller did.
  void describe(const ControlSummary& summary);
  /// Writes the statistics and gives the file its final name.
  void finish(const std::string& solver, const SolverStatistics& statistics);

  PartFile& file() { return file_; }

 private:
  using Clock = std::chrono::steady_clock;

  PartFile file_;
  RunContents contents_;
  std::optional<GrowingTable> trajectory_, events_, controller_;
  Clock::time_point flushed_;
};

/// The resolved scenario that a result file carries, as TOML; throws OutputFault if there is none.
std::string read_stored_scenario(const std::string& path);

}  // namespace wormdrive
