#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "description/diagnostics.hpp"
#include "description/scenario.hpp"
#include "diagnosis/files/data_table.hpp"

namespace wormdrive {

/// A column of a recording as it stands in its file, in SI.
struct RecordedValues {
  std::string name;            ///< as the file calls it, with its unit
  double unit = 1.0;           ///< SI per unit of the file
  std::vector<double> values;  ///< empty: the file has no such column

  /// A value as the file spells it.
  double in_file(double si) const { return si / unit; }
};

/// What a column of measured data is called in the files of a scenario, "motor_torque_Nm" if it says nothing else.
std::string recorded_name(std::string_view name, const Scenario& scenario);

/// A column of measured data in SI, by its name without the unit; empty where it may be absent and is. The unit is the
/// one that the file states beside the column, or else that of its name. Throws InputFault.
RecordedValues recorded_values(const DataTable& table, std::string_view name, const Scenario& scenario, bool required);

/// Whether a table has a column of that quantity.
bool has_recorded(const DataTable& table, std::string_view name, const Scenario& scenario);

/// The columns of a recording, each as long as the time's.
struct RecordedTable {
  std::string path;
  bool has_lines = true;  ///< a text file
  RecordedValues time, torque, angle;
  RecordedValues worm_angle, speed;  ///< may be empty
  Axis axis = Axis::rotary;
  std::vector<std::uint32_t> lines{};   ///< of the samples; empty: sample k stands in line k + 2
  std::vector<std::size_t> restarts{};  ///< samples before which so many are missing that nothing connects them

  /// Whether some of the samples within so many on either side lie beyond a pause.
  bool crosses_pause(std::size_t sample, std::size_t half_width) const;
  Location where(std::size_t sample) const;
  Location where() const { return {path}; }
};

/// Whether a file is a run as HDF5; throws InputFault if it is HDF5 that is damaged.
bool is_run_file(const std::string& path);
/// Whether a table is a run as `wormdrive export --mat` writes it.
bool is_exported_run(const DataTable& table);

/// Reads time, commanded motor torque, gear angle and what else there is of a CSV, MAT or HDF5 file, or of a run of
/// this program: the samples of its controller, or its rows at even intervals. Columns are called as usual or as the
/// scenario says; angles may stand in degrees. Throws InputFault.
RecordedTable read_recorded_table(const std::string& path, const Scenario& scenario);

}  // namespace wormdrive
