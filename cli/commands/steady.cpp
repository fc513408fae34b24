#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "cli/arguments/command_set.hpp"
#include "cli/arguments/common_options.hpp"
#include "cli/describe/drive.hpp"
#include "cli/shell_words.hpp"
#include "description/diagnostics.hpp"
#include "description/keys.hpp"
#include "description/toml/write_scenario.hpp"
#include "diagnosis/data/recorded_table.hpp"
#include "diagnosis/data/speed_torque_records.hpp"
#include "diagnosis/rules/recordings.hpp"
#include "output/hdf5/table.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/operating_range.hpp"
#include "simulation/steady_scenario.hpp"

namespace wormdrive {
namespace {

struct SteadyOptions {
  ScenarioOptions scenario;
  std::string output;
  std::string data;                 ///< CSV of records at constant speed
  std::optional<double> max_speed;  ///< worm speed [rad/s]
  int points = 41;
  Replace replace = Replace::same_kind;
};

/// Model torques beside measured ones.
struct Comparison {
  std::vector<SpeedTorqueRecord> records;
  std::vector<double> model;  ///< [N m], as many as records
  double rms_error = 0.0;     ///< [N m]
  double rms_torque = 0.0;    ///< [N m]
};

double rms(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values) sum += value * value;
  return std::sqrt(sum / static_cast<double>(values.size()));
}

Comparison compare(const Scenario& scenario, const std::string& data, std::vector<SpeedTorqueRecord> records) {
  Comparison comparison{std::move(records), {}, 0.0, 0.0};
  std::vector<double> errors, torques;
  for (const SpeedTorqueRecord& record : comparison.records) {
    if (record.worm_speed == 0.0)
      reject({data},
             fmt::format("record {} does not move; a torque at standstill is not that of a motion", record.name));
    comparison.model.push_back(steady_torque(scenario, record.worm_speed));
    errors.push_back(record.motor_torque - comparison.model.back());
    torques.push_back(record.motor_torque);
  }
  comparison.rms_error = rms(errors);
  comparison.rms_torque = rms(torques);
  return comparison;
}

struct Curve {
  std::vector<double> speed, torque;
};

/// From -max to max without standstill, where the torque is not a number but an interval.
Curve make_curve(const Scenario& scenario, double max_speed, int points) {
  Curve curve;
  for (const double direction : {-1.0, 1.0})
    for (int k = 0; k < points; ++k) {
      const double share = (k + 0.5) / points;
      curve.speed.push_back(max_speed * (direction < 0.0 ? share - 1.0 : share));
      curve.torque.push_back(steady_torque(scenario, curve.speed.back()));
    }
  return curve;
}

void write(const std::string& output, const Scenario& scenario, const Curve& curve,
           const std::optional<Comparison>& comparison, const SteadyOptions& options) {
  PartFile file(output, "steady", options.replace);
  write_provenance(file.file(), {"steady", scenario.title, to_toml(scenario), options.scenario.command_line});
  GrowingTable(
      file.file(), "model",
      {{"worm_speed", units_on(scenario.axis, "rad/s"), in_words_of(scenario.axis, "worm speed")},
       {"motor_torque", units_on(scenario.axis, "N m"), in_words_of(scenario.axis, "motor torque of the model")}})
      .append({curve.speed, curve.torque});
  if (comparison) {
    write_attribute(file.file(), "rms_error", comparison->rms_error);
    write_attribute(file.file(), "rms_torque", comparison->rms_torque);
    std::vector<std::vector<double>> columns(5);
    std::vector<std::string> names;
    for (std::size_t k = 0; k < comparison->records.size(); ++k) {
      const SpeedTorqueRecord& record = comparison->records[k];
      names.push_back(record.name);
      columns[0].push_back(record.worm_speed);
      columns[1].push_back(record.motor_torque);
      columns[2].push_back(comparison->model[k]);
      columns[3].push_back(static_cast<double>(record.samples));
      columns[4].push_back(static_cast<double>(record.left_out.size()));
    }
    GrowingTable(file.file(), "records",
                 {{"worm_speed", "rad/s", "mean worm speed"},
                  {"motor_torque", "N m", "mean measured motor torque"},
                  {"motor_torque_model", "N m", "motor torque of the model"},
                  {"samples", "1", "samples in the means"},
                  {"left_out", "1", "implausible samples left out"}})
        .append(columns);
    const Hdf5Handle group(H5Gopen2(file.file(), "records", H5P_DEFAULT), H5Gclose, "cannot write records");
    write_texts(group, "record", "name of the record", names);
  }
  file.finish();
}

nlohmann::json as_json(const Scenario& scenario, const Curve& curve, const std::optional<Comparison>& comparison) {
  const auto key = [&](std::string_view name, const Unit& unit) {
    return spellings(name, unit, scenario.axis).front().key;
  };
  nlohmann::json result{{"title", scenario.title},
                        {key("worm_speed", unit::radian_per_second), curve.speed},
                        {key("motor_torque", unit::newton_metre), curve.torque}};
  if (!comparison) return result;
  result["rms_error_Nm"] = comparison->rms_error;
  result["rms_torque_Nm"] = comparison->rms_torque;
  for (std::size_t k = 0; k < comparison->records.size(); ++k) {
    const SpeedTorqueRecord& record = comparison->records[k];
    nlohmann::json left_out = nlohmann::json::array();
    for (const ImplausibleSample& s : record.left_out)
      left_out.push_back({{"line", s.line}, {"torque_Nm", s.torque}, {"deviations", s.deviations}});
    result["records"].push_back({{"record", record.name},
                                 {"worm_speed_rad_per_s", record.worm_speed},
                                 {"motor_torque_Nm", record.motor_torque},
                                 {"motor_torque_model_Nm", comparison->model[k]},
                                 {"samples", record.samples},
                                 {"left_out", left_out}});
  }
  return result;
}

void print_curve(const Curve& curve, Axis axis) {
  fmt::print("\n  {:>20} {:>20}\n",
             fmt::format("{} [{}]", axis == Axis::linear ? "speed" : "worm speed", units_on(axis, "rad/s")),
             fmt::format("motor {} [{}]", axis == Axis::linear ? "force" : "torque", units_on(axis, "N m")));
  const std::size_t stride = std::max<std::size_t>(1, curve.speed.size() / 10);
  for (std::size_t k = stride / 2; k < curve.speed.size(); k += stride)
    fmt::print("  {:>20.6g} {:>20.6g}\n", curve.speed[k], curve.torque[k]);
}

void print_comparison(const Comparison& comparison, const std::string& data, const std::string& torque) {
  for (const SpeedTorqueRecord& record : comparison.records)
    for (const ImplausibleSample& s : record.left_out)
      print_item("left out", fmt::format("{}: record {}: {} = {:g} is {:.0f} robust standard deviations "
                                         "from its record's median (limit {:.0f})",
                                         to_string({data, s.line}), record.name, torque, s.torque, s.deviations,
                                         rules::impossible_deviations));
  print_item("compared",
             fmt::format("rms error {:.4f} mN m over {} mean torques of rms {:.4f} mN m", 1e3 * comparison.rms_error,
                         comparison.records.size(), 1e3 * comparison.rms_torque));
}

int steady_command(const SteadyOptions& options) {
  for (const std::string& input : {options.scenario.file, options.data}) reject_overwriting(options.output, input);
  const Scenario scenario = load_scenario(options.scenario.file, options.scenario.overrides, Purpose::look);
  if (scenario.axis == Axis::linear && !options.data.empty())
    reject({options.data}, "records are torques over worm speeds, but mesh.axis = \"linear\" has no worm");
  std::optional<Comparison> comparison;
  if (!options.data.empty())
    comparison = compare(scenario, options.data, read_speed_torque_records(options.data, scenario));
  double fastest_record = 0.0;
  if (comparison)
    for (const SpeedTorqueRecord& record : comparison->records)
      fastest_record = std::max(fastest_record, 1.05 * std::abs(record.worm_speed));
  const double max_speed = options.max_speed ? *options.max_speed
                           : comparison      ? fastest_record
                                             : operating_range(scenario).worm_speed;
  const Curve curve = make_curve(scenario, max_speed, options.points);
  if (!options.output.empty()) write(options.output, scenario, curve, comparison, options);
  if (options.scenario.json) {
    print_json(as_json(scenario, curve, comparison));
    return 0;
  }
  if (options.scenario.quiet) return 0;
  fmt::print("{}\n", scenario.title);
  if (const std::string mesh = describe_mesh(scenario); !mesh.empty()) print_item("regime", mesh);
  for (const std::string& warning : warnings(scenario, MotorTorque::sought)) print_item("warning", warning);
  if (scenario.axis == Axis::rotary)
    print_item("load", fmt::format("{:g} N m, at the initial angle and time 0", rest_at_start(scenario).load));
  if (comparison)
    print_comparison(*comparison, options.data, recorded_name("motor_torque", scenario));
  else
    print_curve(curve, scenario.axis);
  if (!options.output.empty())
    print_item("wrote", fmt::format("{}    see it: wormdrive plot {}", options.output, shell_path(options.output)));
  return 0;
}

}  // namespace

void add_steady(CommandSet& commands) {
  auto [command, options] = commands.add("steady", "compute the motor torque at constant speed", steady_command);
  add_scenario_options(command, options.scenario);
  add_optional_output(command, options.output);
  command.add_option("--data", options.data,
                     "records to compare with the model: a file (.csv, .mat, .h5) with the columns record, "
                     "worm_speed_rad_per_s, motor_torque_Nm");
  command
      .add_option("--max-speed", options.max_speed,
                  "largest worm speed [rad/s]; default: that of the data, or of the scenario's run")
      ->check(finite_number(false));
  command.add_option("--points", options.points, "number of speeds in each direction")
      ->check(CLI::Range(1, 100000))
      ->capture_default_str();
  add_force(command, options.replace);
}

}  // namespace wormdrive
