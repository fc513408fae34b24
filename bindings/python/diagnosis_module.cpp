#include <optional>

#include <nlohmann/json.hpp>
#include <pybind11/stl.h>

#include "bindings/python/module.hpp"
#include "bindings/python/numpy_table.hpp"
#include "bindings/python/signals.hpp"
#include "description/toml/write_scenario.hpp"
#include "diagnosis/diagnose_files.hpp"
#include "diagnosis/report/diagnosis_file.hpp"
#include "diagnosis/report/diagnosis_folder.hpp"
#include "diagnosis/report/diagnosis_json.hpp"
#include "statistics/threads.hpp"

namespace py = pybind11;

namespace wormdrive {
namespace {

/// Where what was found is to be kept, and what a file of it says of its origin.
struct Kept {
  std::optional<DiagnosisFolder> folder;
  std::string command_line;
};
Kept kept(const std::optional<std::string>& output, std::vector<std::string> inputs, const std::string& scenario_file,
          const std::string& command_line) {
  if (!output) return {};
  if (!scenario_file.empty()) inputs.push_back(scenario_file);
  return {DiagnosisFolder(*output, inputs), command_line};
}

/// What was found: the JSON of a report, the scenarios that follow, the residual torque as a table.
py::dict diagnose(const Scenario& scenario, const std::vector<std::string>& files,
                  const std::vector<std::string>& since, std::uint64_t seed, int draws, unsigned threads,
                  const Kept& kept) {
  DiagnosisSettings settings;
  settings.seed = seed;
  settings.draws = draws;
  settings.threads = static_cast<int>(threads_for(threads));
  const DataKind kind = kind_of_data(files, scenario);
  Diagnosis found = without_python([&](SignalWatch& watch) {
    settings.progress = [&](const std::string&) { watch(); };
    return since.empty() ? diagnose_files(scenario, kind, files, settings)
                         : diagnose_since(scenario, since, kind, files, settings);
  });
  const nlohmann::json findings = as_json(found, name(kind), files);
  if (kept.folder)
    kept.folder->write(found, findings, scenario.title, kept.command_line, [] { return std::vector<std::string>{}; });
  ResidualTorque& r = found.residual;
  py::dict result;
  result["findings"] = findings.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
  result["extended"] = extended_file(found);
  result["experiment"] = found.experiment ? py::object(py::str(to_toml(*found.experiment))) : py::none();
  py::list residual;
  const auto column = [&](const char* name, const char* units, const char* what, std::vector<double>& values) {
    residual.append(described(on_axis(scenario.axis, {{name, units, what}}).front(), own(std::move(values))));
  };
  column("time", "s", "time of the sample", r.time);
  column("gear_angle", "rad", "gear angle", r.gear_angle);
  column("gear_speed", "rad/s", "gear speed", r.gear_speed);
  column("load_torque", "N m", "load torque", r.load_torque);
  column("before", "N m", "torque that the stated model lacks", r.before);
  column("after", "N m", "torque that the extended model lacks", r.after);
  result["residual"] = residual;
  return result;
}

}  // namespace

void add_diagnosis(py::module_& m) {
  m.def("diagnose", [](const Scenario& scenario, const std::vector<std::string>& files,
                       const std::vector<std::string>& since, std::uint64_t seed, int draws, unsigned threads,
                       const std::optional<std::string>& output, const std::string& scenario_file,
                       const std::string& command_line) {
    std::vector<std::string> inputs = files;
    inputs.insert(inputs.end(), since.begin(), since.end());
    return diagnose(scenario, files, since, seed, draws, threads, kept(output, inputs, scenario_file, command_line));
  });
}

}  // namespace wormdrive
