// The module _core of the Python package: scenarios, runs and their columns; wormdrive/__init__.py makes it handy.
#include "bindings/python/module.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "bindings/python/numpy_table.hpp"
#include "bindings/python/run_result.hpp"
#include "bindings/python/signals.hpp"
#include "description/diagnostics.hpp"
#include "description/keys.hpp"
#include "description/quantities.hpp"
#include "description/toml/write_scenario.hpp"
#include "description/warnings.hpp"
#include "output/hdf5/hdf5.hpp"
#include "output/program.hpp"
#include "simulation/load_scenario.hpp"
#include "simulation/steady_scenario.hpp"
#include "simulation/stepping/stepped_drive.hpp"

namespace py = pybind11;
using namespace wormdrive;

namespace {

RunResult run(std::shared_ptr<const Scenario> scenario) {
  RunResult result(std::move(scenario));
  without_python([&](SignalWatch& watch) { result.run([&](double) { watch(); }); });
  return result;
}

/// A table, described as in a result file.
template <class Source>
py::list table(const std::vector<RunColumn<Source>>& columns, Axis axis, const std::vector<Source>& rows) {
  py::list list;
  const std::vector<ColumnDescription> all = descriptions(columns, axis);
  for (std::size_t k = 0; k < columns.size(); ++k)
    list.append(described(
        all[k], all[k].is_flag() ? own(column<std::int8_t>(columns[k], rows)) : own(column<double>(columns[k], rows))));
  return list;
}

/// A table that runs have.
struct RunTable {
  std::string_view name;
  bool (*is_in)(const Scenario&);
  py::list (*columns)(const RunResult&);
};
/// Every table of a run; a new one is an entry here and a property of Result in wormdrive/__init__.py.
const std::array run_tables{
    RunTable{"trajectory", [](const Scenario&) { return true; },
             [](const RunResult& r) {
               return table(trajectory_columns(r.contents()), r.scenario().axis, r.trajectory().rows);
             }},
    RunTable{"events", [](const Scenario&) { return true; },
             [](const RunResult& r) {
               return table(event_columns(r.contents()), r.scenario().axis, r.trajectory().events);
             }},
    RunTable{"controller", [](const Scenario& s) { return s.control.has_value(); },
             [](const RunResult& r) { return table(controller_columns(), r.scenario().axis, r.samples()); }}};

std::vector<std::string_view> names_of_tables(const Scenario& scenario) {
  std::vector<std::string_view> names;
  for (const RunTable& t : run_tables)
    if (t.is_in(scenario)) names.push_back(t.name);
  return names;
}
/// The columns of one of them.
py::list table_named(const RunResult& r, std::string_view name) {
  const auto* const found = std::ranges::find(run_tables, name, &RunTable::name);
  if (found == run_tables.end()) throw py::key_error(std::string(name));
  return found->columns(r);
}

py::dict as_dict(const std::vector<Quantity>& list) {
  py::dict all;
  for (const Quantity& q : list) {
    py::dict one;
    one["value"] = q.value;
    one["unit"] = q.unit;
    one["meaning"] = q.meaning;
    all[py::str(q.name)] = one;
  }
  return all;
}

py::object steady(const Scenario& scenario, const py::array_t<double, py::array::forcecast>& speeds) {
  const auto torque = [&](double speed) {
    const std::string at = fmt::format("worm_speed = {} {}", speed, units_on(scenario.axis, "rad/s"));
    if (!std::isfinite(speed)) reject({at}, "must be a finite number");
    if (speed == 0.0) {
      const RestAtStart rest = rest_at_start(scenario);
      reject({at},
             fmt::format("at rest every motor {} from {:.6g} to {:.6g} {} holds the drive; ask for another speed",
                         in_words_of(scenario.axis, "torque"), rest.low, rest.high, units_on(scenario.axis, "N m")));
    }
    return steady_torque(scenario, speed);
  };
  return py::vectorize(torque)(speeds);
}

Purpose purpose(bool look) { return look ? Purpose::look : Purpose::run; }

}  // namespace

PYBIND11_MODULE(_core, m) {
  m.doc() = "C++ core of wormdrive.";
  py::register_exception<InputFault>(m, "InputError", PyExc_ValueError);
  py::register_exception<OutputFault>(m, "OutputError", PyExc_OSError);
  py::register_exception<SimulationFailure>(m, "SimulationHalted", PyExc_RuntimeError);
  m.def("version", &build_description);

  py::class_<RunResult>(m, "Run")
      .def("tables", [](const RunResult& r) { return names_of_tables(r.scenario()); })
      .def("table", &table_named)
      .def_property_readonly("title", [](const RunResult& r) { return r.scenario().title; })
      .def_property_readonly("toml", [](const RunResult& r) { return to_toml(r.scenario()); })
      .def_property_readonly("halted", &RunResult::halted)
      .def("metrics", &RunResult::metrics)
      .def("statistics", &RunResult::statistics)
      .def("write", &RunResult::write, py::arg("path"), py::arg("command_line"), py::arg("force"));

  py::class_<Scenario, std::shared_ptr<Scenario>> core(m, "Scenario");
  core.def_static("load", [](const std::string& path, const std::vector<std::string>& overrides,
                             bool look) { return load_scenario(path, overrides, purpose(look)); })
      .def_static("parse",
                  [](const std::string& text, const std::string& name, const std::vector<std::string>& overrides,
                     bool look) { return parse_scenario(text, name, overrides, purpose(look)); })
      .def_readonly("title", &Scenario::title)
      .def_property_readonly("toml", &to_toml)
      .def("run", [](const std::shared_ptr<Scenario>& s) { return run(s); })
      .def("steady", &steady)
      .def("parameters", [](const Scenario& s) { return as_dict(parameters(s)); })
      .def("derived", [](const Scenario& s) { return as_dict(derived(s)); })
      .def("warnings", [](const Scenario& scenario) { return warnings(scenario); })
      .def("set_aside", &set_aside)
      .def(py::pickle([](const Scenario& s) { return py::make_tuple(to_toml(s)); },
                      [](const py::tuple& state) {
                        return std::make_shared<Scenario>(
                            parse_scenario(state[0].cast<std::string>(), "scenario", {}, Purpose::show));
                      }));
  pickle_by_every_protocol(core);
  add_sweep(m);
  add_diagnosis(m);
  add_stepping(m);
}
