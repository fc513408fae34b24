#include "diagnosis/data/speed_torque_records.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "description/diagnostics.hpp"
#include "diagnosis/data/recorded_table.hpp"
#include "diagnosis/rules/recordings.hpp"
#include "statistics/robust.hpp"

namespace wormdrive {
namespace {

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Standard deviation that rounding to the common step between the values leaves: where most samples are equal they
/// show no other spread. The median, because a file's last digit may round the steps differently.
double quantisation_deviation(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  std::vector<double> steps;
  for (std::size_t k = 1; k < values.size(); ++k)
    if (values[k] > values[k - 1]) steps.push_back(values[k] - values[k - 1]);
  return steps.empty() ? 0.0 : median(std::move(steps)) / std::sqrt(12.0);
}

SpeedTorqueRecord summarise(const std::string& name, const std::vector<double>& speeds,
                            const std::vector<double>& torques, const std::vector<std::uint32_t>& lines) {
  const double centre = median(torques);
  std::vector<double> distances;
  for (const double torque : torques) distances.push_back(std::abs(torque - centre));
  const double sigma = std::max(1.4826 * median(distances), quantisation_deviation(torques));
  SpeedTorqueRecord record{name, 0.0, 0.0, 0, {}};
  std::vector<double> kept_speeds, kept_torques;
  for (std::size_t k = 0; k < torques.size(); ++k) {
    if (distances[k] > rules::impossible_deviations * sigma) {
      record.left_out.push_back({lines[k], torques[k], distances[k] / sigma});
    } else {
      kept_speeds.push_back(speeds[k]);
      kept_torques.push_back(torques[k]);
    }
  }
  record.worm_speed = mean(kept_speeds);
  record.motor_torque = mean(kept_torques);
  record.samples = kept_torques.size();
  return record;
}

}  // namespace

std::vector<SpeedTorqueRecord> read_speed_torque_records(const std::string& path, const Scenario& scenario) {
  const DataTable table = read_data_table(path);
  const std::vector<std::string> names = table.texts(recorded_name("record", scenario));
  const RecordedValues speed = recorded_values(table, "worm_speed", scenario, true),
                       torque = recorded_values(table, "motor_torque", scenario, true);
  for (const RecordedValues* column : {&speed, &torque})
    require_equal_lengths(table, recorded_name("record", scenario), names.size(), column->name, column->values.size());
  const std::vector<double>&speeds = speed.values, &torques = torque.values;
  if (names.empty()) reject({path}, "there are no samples below the header line");
  std::vector<std::string> order;
  for (const std::string& name : names)
    if (std::find(order.begin(), order.end(), name) == order.end()) order.push_back(name);
  std::vector<SpeedTorqueRecord> records;
  for (const std::string& name : order) {
    std::vector<double> record_speeds, record_torques;
    std::vector<std::uint32_t> lines;
    for (std::size_t k = 0; k < names.size(); ++k) {
      if (names[k] != name) continue;
      record_speeds.push_back(speeds[k]);
      record_torques.push_back(torques[k]);
      lines.push_back(table.row(k).line);
    }
    records.push_back(summarise(name, record_speeds, record_torques, lines));
  }
  return records;
}

}  // namespace wormdrive
