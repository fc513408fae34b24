#pragma once
// A recording as a CSV file in memory, sound, to be spoiled cell by cell.
#include <functional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/program.hpp"
#include "diagnosis/data/read_recording.hpp"
#include "diagnosis/recordings.hpp"
#include "recovery/truth/excitation.hpp"

namespace wormdrive::test {

/// A CSV file in memory: cells by column and row.
struct Sheet {
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;

  std::string text() const {
    std::string all;
    const auto line = [&](const std::vector<std::string>& cells) {
      for (std::size_t k = 0; k < cells.size(); ++k) all += (k ? "," : "") + cells[k];
      all += "\n";
    };
    line(names);
    for (const auto& row : rows) line(row);
    return all;
  }
  double number(std::size_t row, std::size_t column) const { return std::stod(rows[row][column]); }
  void put(std::size_t row, std::size_t column, double value) { rows[row][column] = fmt::format("{:.9g}", value); }
  void each(std::size_t column, const std::function<double(double, std::size_t)>& change) {
    for (std::size_t k = 0; k < rows.size(); ++k) put(k, column, change(number(k, column), k));
  }
};

/// Eight seconds of the bench as it should be written down: 8000 samples, encoder of 16384 counts.
inline const Sheet& sound() {
  static const Sheet sheet = [] {
    truth::Drive drive;
    drive.sensor.counts = 16384;
    const auto r = truth::record(drive, truth::follow(truth::rich_course(3, 8.0), truth::Sheet{}),
                                 {.duration = 8.0, .seed = 9});
    Sheet made{{"time_s", "motor_torque_Nm", "gear_angle_rad"}, {}};
    for (std::size_t k = 0; k < r.time.size(); ++k)
      made.rows.push_back({fmt::format("{:.6g}", r.time[k]), fmt::format("{:.9g}", r.motor_torque[k]),
                           fmt::format("{:.9g}", r.gear_angle[k])});
    return made;
  }();
  return sheet;
}

inline Recording read(const Folder& folder, const Sheet& sheet, const Scenario& scenario = nominal_arm()) {
  folder.write("r.csv", sheet.text());
  return read_recording(folder / "r.csv", scenario);
}

}  // namespace wormdrive::test
