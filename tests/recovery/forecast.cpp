#include "recovery/forecast.hpp"

#include <algorithm>
#include <regex>
#include <sstream>
#include <stdexcept>
#include <variant>

#include "description/toml/parse_scenario.hpp"
#include "description/toml/write_scenario.hpp"
#include "diagnosis/candidates/coordinates.hpp"
#include "diagnosis/faults/recording_faults.hpp"
#include "diagnosis/report/uncertainty_study.hpp"
#include "simulation/run_batch.hpp"
#include "sweep/study/load_study.hpp"
#include "sweep/summary/statistics.hpp"
#include "sweep/trial.hpp"

namespace recovery {
namespace {

/// Slower and wider than most of a recording, and at rest twice in a period; the second of two.
constexpr const char* task = R"(
[controller]
kind = "pid"
sample_time_s = 1e-3
integral_weight = 4.0
angle_weight = 1.0
speed_weight = 1e-3
feedforward = 1.0

[sensor]
speed_filter_Hz = 100

[reference]
kind = "sinusoid"
amplitude_rad = 0.8
frequency_Hz = 0.5

[metrics]
from_s = 2
)";

/// A drive with the task.
wormdrive::Scenario at_work(const wormdrive::Scenario& drive) {
  return wormdrive::parse_scenario(wormdrive::to_toml(drive) + task, "task.toml",
                                   {"run.solver=taylor", "run.duration_s=4", "run.report_interval_s=4"},
                                   wormdrive::Purpose::run);
}

/// The data sheet with all in which the drive differs from it.
wormdrive::Scenario as_it_is(const Case& drawn, const truth::Drive& drive) {
  wormdrive::Scenario scenario = data_sheet(drawn);
  for (const truth::Secret& secret : truth::catalogue()) {
    if (secret.needs_worm_encoder) continue;
    for (const truth::TrueParameter& parameter : secret.parameters)
      if (const double value = parameter.of(drive); value != parameter.of(drawn.stated))
        wormdrive::set_field(scenario.effects, {secret.effect, parameter.field, value});
  }
  return scenario;
}

/// The draws of a diagnosis as a study that was read keeps them, without their file.
std::string in_text(const wormdrive::Diagnosis& found) {
  const std::string csv = wormdrive::uncertainty_draws(found);
  if (csv.empty()) return "";
  std::vector<std::string> columns;
  std::istringstream lines(csv);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    std::size_t k = 0;
    for (std::string cell; std::getline(cells, cell, ','); ++k)
      if (k < columns.size())
        columns[k] += cell + ",";
      else
        columns.push_back("\"" + cell + "\" = [");
  }
  std::string text = "\n[data.\"" + std::string(wormdrive::draws_file) + "\"]\n";
  for (const std::string& column : columns) text += column + "]\n";
  return text;
}

/// The study of a diagnosis for the task.
wormdrive::Study study_of(const std::string& stated, const wormdrive::Diagnosis& found, std::uint64_t trials) {
  wormdrive::Scenario median = found.extended;
  const wormdrive::JointEstimate& open = found.uncertainty;
  for (std::size_t k = 0; k < open.numbers.size(); ++k)
    if (!wormdrive::is_recording_fault(open.effects[k]))
      wormdrive::set_field(median.effects, {open.effects[k], open.numbers[k].field, open.numbers[k].value});
  const std::string text =
      std::regex_replace(stated, std::regex("\ntrials = [0-9]+"), "\ntrials = " + std::to_string(trials));
  return wormdrive::parse_study(
      "metrics = [\"error_rms\", \"error_max\", \"torque_peak\", \"torque_rms\"]\n" + text + in_text(found),
      wormdrive::to_toml(at_work(median)), "uncertainty.toml");
}

}  // namespace

std::vector<Forecast> forecast(const Case& drawn, const truth::Drive& drive, const wormdrive::Diagnosis& found,
                               std::uint64_t trials) {
  const std::string stated = wormdrive::uncertainty_study(found);
  if (stated.empty()) return {};
  const wormdrive::Study study = study_of(stated, found, trials);
  std::vector<std::vector<double>> possible_values(study.metrics.size());
  wormdrive::Trials possible(study);
  possible.make({0, trials}, [&](const wormdrive::Trial& trial) {
    if (trial.status != wormdrive::TrialStatus::done)
      throw std::runtime_error("a possible drive cannot do the task: " + trial.reason);
    for (std::size_t k = 0; k < trial.metrics.size(); ++k) possible_values[k].push_back(trial.metrics[k]);
  });

  const wormdrive::Scenario truth = at_work(as_it_is(drawn, drive));
  const auto done = wormdrive::run_batch({&truth, 1}).front();
  if (const auto* const why = std::get_if<std::string>(&done))
    throw std::runtime_error("the true drive cannot do the task: " + *why);
  const wormdrive::Outcome of_truth{std::get<wormdrive::RunSummary>(done), {}};

  std::vector<Forecast> list;
  for (std::size_t k = 0; k < study.metrics.size(); ++k) {
    std::vector<double>& values = possible_values[k];
    std::sort(values.begin(), values.end());
    const auto quantile = [&](double p) {
      return wormdrive::sample_quantile(wormdrive::quantile_ranks(values.size(), p),
                                        [&](std::uint64_t rank) { return values[rank]; })
          .value;
    };
    const wormdrive::Metric& metric = study.metrics[k];
    list.push_back({metric.name, quantile(0.025), quantile(0.975), metric.of(of_truth)});
  }
  return list;
}

std::vector<std::string> told_effects() {
  return {"mesh_friction", "friction_asymmetry", "static_friction", "worm_coulomb",   "worm_viscous",
          "gear_coulomb",  "gear_viscous",       "worm_inertia",    "gear_inertia",   "torque_gain",
          "torque_offset", "actuator_delay",     "actuator_lag",    "load_magnitude", "load_angle"};
}

}  // namespace recovery
