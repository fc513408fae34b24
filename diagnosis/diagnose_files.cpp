#include "diagnosis/diagnose_files.hpp"

#include <algorithm>
#include <stdexcept>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "description/diagnostics.hpp"
#include "description/keys.hpp"
#include "description/rejection.hpp"
#include "diagnosis/candidates/catalogue.hpp"
#include "diagnosis/changes.hpp"
#include "diagnosis/data/read_recording.hpp"
#include "diagnosis/data/recorded_table.hpp"
#include "diagnosis/diagnose.hpp"
#include "diagnosis/points/break_in_points.hpp"
#include "diagnosis/points/point_diagnosis.hpp"
#include "diagnosis/points/steady_points.hpp"
#include "diagnosis/rules/recordings.hpp"
#include "output/resource.hpp"

namespace wormdrive {
namespace {

DataKind kind_of(const std::string& file, const Scenario& scenario) {
  if (is_run_file(file)) return DataKind::recording;
  const DataTable table = read_data_table(file);
  const auto called = [&](std::string_view name) { return recorded_name(name, scenario); };
  const auto has = [&](std::string_view name) { return has_recorded(table, name, scenario); };
  if (is_exported_run(table)) return DataKind::recording;
  if (has("record") && has("worm_speed")) return DataKind::speed_torque_records;
  if (has("time")) return DataKind::recording;
  if (has("load_torque") && has("motor_torque")) return DataKind::break_in_table;
  const std::string torque = called("motor_torque");
  reject(table.header(),
         fmt::format("the columns {} make neither a recording ({}, {}, {}) nor records at constant speed ({}, {}, {}) "
                     "nor a break-in table ({}, {}); [data] in the scenario tells other names, see {}",
                     fmt::join(table.names(), ", "), called("time"), torque, called("gear_angle"), called("record"),
                     called("worm_speed"), torque, called("load_torque"), torque, documentation_page("recordings.md")));
}

std::string left_out(const std::string& file, const SpeedTorqueRecord& record, const ImplausibleSample& sample,
                     const Scenario& scenario) {
  return fmt::format("{}: record {}: {} = {:g} is {:.0f} robust standard deviations from its record's median; left out",
                     to_string({file, sample.line}), record.name, recorded_name("motor_torque", scenario),
                     sample.torque, sample.deviations);
}

Diagnosis of_records(const Scenario& scenario, const std::vector<std::string>& files,
                     const DiagnosisSettings& settings) {
  std::vector<SpeedTorqueRecord> records;
  std::vector<std::string> remarks;
  for (const std::string& file : files)
    for (const SpeedTorqueRecord& record : read_speed_torque_records(file, scenario)) {
      for (const ImplausibleSample& sample : record.left_out)
        remarks.push_back(left_out(file, record, sample, scenario));
      if (record.worm_speed == 0.0)
        reject({file}, fmt::format("record {} stands still; its {} is that of no motion", record.name,
                                   in_words_of(scenario.axis, "torque")));
      records.push_back(record);
    }
  std::sort(records.begin(), records.end(), [](const SpeedTorqueRecord& a, const SpeedTorqueRecord& b) {
    return std::tie(a.worm_speed, a.motor_torque, a.name) < std::tie(b.worm_speed, b.motor_torque, b.name);
  });  // so that the order of the files makes no difference
  if (records.size() < rules::least_rows)
    reject({files.front()}, fmt::format("{} records at constant speed; a diagnosis needs at least {}, in both "
                                        "directions",
                                        records.size(), rules::least_rows));
  const TorquePoints points = steady_points(records, scenario);
  Diagnosis diagnosis = diagnose(
      scenario, points, steady_points_at_two_loads(records, scenario, 2.0 * points.load_torque.front()), settings);
  diagnosis.remarks.insert(diagnosis.remarks.begin(), remarks.begin(), remarks.end());
  return diagnosis;
}

Diagnosis of_break_ins(const Scenario& scenario, const std::vector<std::string>& files,
                       const DiagnosisSettings& settings) {
  std::vector<BreakIn> table;
  for (const std::string& file : files)
    for (const BreakIn& row : read_break_in_table(file, scenario)) table.push_back(row);
  std::sort(table.begin(), table.end(), [](const BreakIn& a, const BreakIn& b) {
    return std::tie(a.load_torque, a.motor_torque) < std::tie(b.load_torque, b.motor_torque);
  });
  const TorquePoints points = break_in_points(table, scenario);
  Diagnosis diagnosis = diagnose(scenario, points, std::nullopt, settings);
  diagnosis.identified = identified_constants(points, scenario);
  diagnosis.remarks.push_back(
      "mu_s and the pressure angle enter as mu_s/cos(pressure angle) alone: no break-in torque tells one from the "
      "other");
  return diagnosis;
}

Diagnosis of_recordings(const Scenario& scenario, const std::vector<std::string>& files,
                        const DiagnosisSettings& settings, const std::map<std::string, LoadParameters>& loads) {
  // before what such a drive would need for the motion is compared with what the recordings state
  if (const std::string why = why_not_diagnosed(scenario.effects); !why.empty()) reject({files.front()}, why);
  std::vector<Recording> recordings;
  std::vector<std::string> remarks;
  for (const std::string& file : files) {
    recordings.push_back(read_recording(file, scenario));
    if (const auto load = loads.find(file); load != loads.end()) recordings.back().load = load->second;
    for (const std::string& remark : recordings.back().remarks) remarks.push_back(file + ": " + remark);
  }
  try {
    Diagnosis diagnosis = diagnose(scenario, recordings, settings);
    diagnosis.remarks.insert(diagnosis.remarks.begin(), remarks.begin(), remarks.end());
    return diagnosis;
  } catch (const std::invalid_argument& fault) {
    reject({files.front()}, fault.what());
  }
}

}  // namespace

std::string name(DataKind kind) {
  switch (kind) {
    case DataKind::recording: return "a recording over time";
    case DataKind::speed_torque_records: return "records at constant speed";
    case DataKind::break_in_table: return "a break-in table";
  }
  return "";
}

DataKind kind_of_data(const std::vector<std::string>& files, const Scenario& scenario) {
  const DataKind first = kind_of(files.front(), scenario);
  for (const std::string& file : files)
    if (const DataKind kind = kind_of(file, scenario); kind != first)
      reject({file}, fmt::format("holds {}, but {} holds {}; diagnose them one by one", name(kind), files.front(),
                                 name(first)));
  return first;
}

Diagnosis diagnose_files(const Scenario& scenario, DataKind kind, const std::vector<std::string>& files,
                         const DiagnosisSettings& settings, const std::map<std::string, LoadParameters>& loads) {
  if (settings.draws > 0 && kind != DataKind::recording)
    reject({files.front()}, fmt::format("holds {}; draws are for a recording over time", name(kind)));
  Diagnosis diagnosis = [&] {
    switch (kind) {
      case DataKind::speed_torque_records: return of_records(scenario, files, settings);
      case DataKind::break_in_table: return of_break_ins(scenario, files, settings);
      case DataKind::recording: return of_recordings(scenario, files, settings, loads);
    }
    return Diagnosis{};
  }();
  if (const auto why = why_the_drive_cannot_run(diagnosis.extended))
    diagnosis.remarks.push_back("the extended scenario cannot be run: " + *why);
  return diagnosis;
}

Diagnosis diagnose_since(const Scenario& scenario, const std::vector<std::string>& earlier, DataKind kind,
                         const std::vector<std::string>& later, const DiagnosisSettings& settings,
                         const std::map<std::string, LoadParameters>& loads) {
  DiagnosisSettings without_draws = settings, known = settings;
  without_draws.draws = 0;
  const Diagnosis then = diagnose_files(scenario, kind_of_data(earlier, scenario), earlier, without_draws, loads);
  const Scenario fitted = as_fitted(scenario, then);
  known.tolerances = known_tolerances(then);
  Diagnosis now = diagnose_files(fitted, kind, later, known, loads);
  tell_changes(then, fitted, now);
  now.since->files = earlier;
  if (then.verdict == Verdict::unexplained || then.verdict == Verdict::ambiguous)
    now.remarks.insert(now.remarks.begin(), fmt::format("of the earlier data: {}", then.sentence));
  return now;
}

}  // namespace wormdrive
