#include "diagnosis/data/read_recording.hpp"

#include <filesystem>

#include "diagnosis/data/forgotten_load.hpp"
#include "diagnosis/data/impossible_samples.hpp"
#include "diagnosis/data/missing_rows.hpp"
#include "diagnosis/data/plausible_units.hpp"
#include "diagnosis/data/recorded_table.hpp"
#include "diagnosis/data/sample_times.hpp"

namespace wormdrive {
Recording read_recording(const std::string& path, const Scenario& scenario) {
  RecordedTable table = read_recorded_table(path, scenario);
  const std::optional<std::string> rounded = even_out_rounded_stamps(table);
  MissingRows rows = bridge_missing_rows(table);
  SampleTimes time = sample_times(table, rows);
  refuse_implausible_units(table, rows.there, time.period, scenario);
  Recording recording;
  recording.name = std::filesystem::path(path).filename().string();
  recording.start = time.start;
  recording.period = time.period;
  recording.times = std::move(time.times);
  recording.remarks = std::move(time.remarks);
  if (rounded) recording.remarks.insert(recording.remarks.begin(), *rounded);
  recording.valid = std::move(rows.there);
  const SampleLimits limits = sample_limits(scenario, time.period, table.torque.values);
  for (std::string& remark : leave_out_impossible(table, limits, recording.valid))
    recording.remarks.push_back(std::move(remark));
  refuse_implausible_size(table, time.period, scenario);
  reject_forgotten_load(table, time.period, scenario);
  recording.restarts = table.restarts;
  recording.gear_resolution = resolution(table.angle.values, recording.valid);
  if (!table.worm_angle.values.empty())
    recording.worm_resolution = resolution(table.worm_angle.values, recording.valid);
  recording.motor_torque = std::move(table.torque.values);
  recording.gear_angle = std::move(table.angle.values);
  recording.worm_angle = std::move(table.worm_angle.values);
  return recording;
}

}  // namespace wormdrive
