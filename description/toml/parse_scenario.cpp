#include "description/toml/parse_scenario.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "core/elastic/elastic_teeth.hpp"
#include "description/data_sheet.hpp"
#include "description/one_line.hpp"
#include "description/rejection.hpp"
#include "description/toml/document.hpp"
#include "description/toml/read_control.hpp"
#include "description/toml/read_effects.hpp"
#include "description/toml/read_load.hpp"
#include "description/toml/read_signal.hpp"
#include "description/toml/table_reader.hpp"

namespace wormdrive {
namespace {

constexpr double most_rows = 1e9;  ///< in a result; whoever asks for more has slipped in the unit

class ScenarioReader {
 public:
  ScenarioReader(const toml::table& root, std::string name, Diagnostics& faults)
      : name_(std::move(name)), root_(&root, "", Axis::rotary, faults, {name_}), faults_(faults) {}

  Scenario read(Purpose purpose) {
    const auto title = purpose == Purpose::show ? root_.text("title") : root_.line("title");
    scenario_.title = title ? *title : one_line(std::filesystem::path(name_).stem().string());
    read_mesh();
    scenario_.motor = read_motor();
    scenario_.load = read_load(root_, folder());
    root_.section("initial", [&](TableReader& table) { table.read_fields(scenario_.initial); });
    read_effects(root_, scenario_, folder(), purpose);
    read_run(purpose);
    read_control(root_, scenario_, folder());
    read_what_is_measured();
    root_.finish();
    if (purpose == Purpose::run && faults_.empty())
      if (const auto why = why_it_cannot_move(scenario_)) faults_.add(friction_at_, *why);
    return std::move(scenario_);
  }

 private:
  std::string folder() const { return std::filesystem::path(name_).parent_path().string(); }

  /// Which keys the mesh has, and how all quantities are spelled, hangs on two words: if one is wrong, the rest cannot
  /// be judged.
  void read_mesh() {
    root_.section("mesh", [&](TableReader& mesh) {
      const auto kind = mesh.choice("kind", {"worm", std::string(DataSheet::kind), "none"}, Presence::optional);
      if (!kind) faults_.raise();
      friction_at_ = mesh.where("friction");
      if (kind == "worm") {
        MeshParameters<double> parameters;
        mesh.read_fields(parameters);
        scenario_.mesh = parameters;
        return;
      }
      if (kind == DataSheet::kind) {
        read_data_sheet(mesh);
        return;
      }
      const auto axis = mesh.choice("axis", {"rotary", "linear"}, Presence::optional);
      if (!axis) faults_.raise();
      if (axis == "linear") {
        scenario_.axis = Axis::linear;
        mesh.set_axis(Axis::linear);
        root_.set_axis(Axis::linear);
      }
      SingleInertia<double> inertia;
      mesh.read_fields(inertia);
      scenario_.mesh = inertia;
    });
  }

  void read_data_sheet(TableReader& mesh) {
    DataSheet sheet;
    mesh.read_fields(sheet);
    if (!faults_.empty() || !(sheet.i > 0.0 && sheet.a > 0.0)) return;  // told already, or by finish()
    scenario_.mesh = mesh_of(sheet, [&](const std::string& key, const std::string& what) { mesh.fault(key, what); });
  }

  Signal read_motor() {
    Signal signal;
    root_.section("motor", [&](TableReader& motor) {
      signal = read_signal(motor.tables("torque"), "motor.torque", motor, folder());
    });
    return signal;
  }

  void read_run(Purpose purpose) {
    if (purpose != Purpose::run && !root_.has("run")) return;
    root_.section("run", [&](TableReader& run) {
      run.read_fields(scenario_.run);
      if (purpose != Purpose::show && scenario_.run.solver == SolverKind::taylor &&
          has_elastic_teeth(scenario_.effects))
        run.fault(
            "solver",
            "run.solver = \"taylor\" supports rigid teeth only, but effect.tooth_compliance makes them elastic; set "
            "run.solver = \"cvode\"");
      const double duration = scenario_.run.duration, every = scenario_.run.rows_every();
      if (duration > 0.0 && every > duration)
        run.fault("report_interval_s",
                  fmt::format("run.report_interval_s = {} s must be at most the duration, {} s", every, duration));
      else if (duration > most_rows * every)
        run.fault("report_interval_s",
                  fmt::format("run.report_interval_s = {} s would give {:.3g} rows; at most {:g} are "
                              "written",
                              every, duration / every, most_rows));
    });
  }

  /// How well the parameters are known, and what the columns of recordings are called.
  void read_what_is_measured() {
    root_.section("tolerance", [&](TableReader& table) {
      Tolerances tolerances;
      table.read_fields(tolerances);
      if (root_.has("tolerance")) scenario_.tolerance = tolerances;
    });
    root_.section("limits", [&](TableReader& table) {
      ExperimentLimits limits;
      table.read_fields(limits);
      if (root_.has("limits")) scenario_.limits = limits;
      if (!limits.low || !limits.high || *limits.low < *limits.high) return;
      const auto key = [&](std::string_view name) { return spellings(name, unit::degrees, scenario_.axis).front(); };
      const Spelling low = key("angle_low"), high = key("angle_high");
      table.fault(low.key, fmt::format("limits.{} = {:g} must be below limits.{} = {:g}", low.key,
                                       *limits.low / low.unit.si, high.key, *limits.high / high.unit.si));
    });
    root_.section("data", [&](TableReader& data) {
      for (const RecordedColumn& column : recorded_columns) {
        const std::string usual = spellings(column.name, column.unit, scenario_.axis).front().key;
        if (const auto called = data.text(usual)) {
          if (called->empty()) data.fault(usual, fmt::format("data.{} = \"\" names no column", usual));
          scenario_.columns[usual] = *called;
        }
      }
    });
  }

  std::string name_;
  TableReader root_;
  Diagnostics& faults_;
  Scenario scenario_;
  Location friction_at_;
};

}  // namespace

Scenario parse_scenario(const std::string& text, const std::string& name, const std::vector<std::string>& overrides,
                        Purpose purpose) {
  const toml::table root = parse_document(text, name, overrides);
  if (root.contains("sweep") && !root.contains("mesh"))
    reject({name}, "this is a study, for wormdrive sweep; the scenario is the file that it names");
  Diagnostics faults;
  Scenario scenario = ScenarioReader(root, name, faults).read(purpose);
  faults.raise();
  return scenario;
}

}  // namespace wormdrive
