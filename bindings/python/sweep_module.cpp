#include <nlohmann/json.hpp>

#include "bindings/python/module.hpp"
#include "bindings/python/numpy_table.hpp"
#include "bindings/python/signals.hpp"
#include "bindings/python/sweep_result.hpp"
#include "description/toml/write_scenario.hpp"
#include "statistics/threads.hpp"
#include "sweep/file/so_far.hpp"
#include "sweep/study/load_study.hpp"
#include "sweep/summary/summary_json.hpp"

namespace py = pybind11;

namespace wormdrive {
namespace {

std::unique_ptr<SweepResult> run(Study study, unsigned threads) {
  auto result = std::make_unique<SweepResult>(std::move(study));
  without_python([&](SignalWatch& watch) { result->run(threads_for(threads), [&] { watch(); }); });
  return result;
}

/// The table of trials, whose arrays look into the result itself.
py::list trials(const py::object& self) {
  const auto& result = self.cast<const SweepResult&>();
  py::list list;
  for (std::size_t k = 0; k < result.columns().size(); ++k) {
    list.append(described(result.columns()[k], view(std::span(result.column(k)), self)));
  }
  return list;
}

/// Study, scenario and rows; the file of a sweep holds no more.
py::tuple state(const SweepResult& r) {
  py::list columns;
  for (std::size_t k = 0; k < r.columns().size(); ++k)
    columns.append(py::array_t<double>(static_cast<py::ssize_t>(r.column(k).size()), r.column(k).data()));
  return py::make_tuple(r.study().text, to_toml(r.study().scenario), columns, r.reasons());
}
std::unique_ptr<SweepResult> restored(const py::tuple& state) {
  auto result =
      std::make_unique<SweepResult>(parse_study(state[0].cast<std::string>(), state[1].cast<std::string>(), "sweep"));
  std::vector<std::vector<double>> columns;
  for (const py::handle column : py::list(state[2])) columns.push_back(column.cast<std::vector<double>>());
  result->restore(std::move(columns), state[3].cast<std::vector<std::string>>());
  return result;
}

/// As JSON; of a sweep that runs or was interrupted, what there is of it.
std::string summary(const std::string& path, const SummarySettings& settings) {
  const py::gil_scoped_release others_may_run;
  const SweepSoFar so_far(path);
  const SweepReader sweep(so_far.path());
  return summary_json(sweep, summary_of(sweep, settings), so_far.running())
      .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

void add_sweep(py::module_& m) {
  py::class_<SweepResult> sweep(m, "Sweep");
  sweep.def_property_readonly("title", [](const SweepResult& r) { return r.study().title; })
      .def("trials", &trials)
      .def("reasons", &SweepResult::reasons)
      .def(
          "write",
          [](const SweepResult& r, const std::string& path, const std::string& command_line, std::size_t referee,
             bool force) {
            const py::gil_scoped_release others_may_run;
            r.write(path, command_line, referee, threads_for(0), force ? Replace::anything : Replace::same_kind);
          },
          py::arg("path"), py::arg("command_line"), py::arg("referee"), py::arg("force"))
      .def(py::pickle(&state, &restored));
  pickle_by_every_protocol(sweep);
  m.def("sweep_file", [](const std::string& path, unsigned threads) { return run(load_study(path), threads); });
  m.def("summary", [](const std::string& path, const std::string& metric, unsigned worst, bool done_only) {
    return summary(path, {.ranked_by = metric, .worst = worst, .done_only = done_only});
  });
  m.def("sweep_text", [](const std::string& text, const std::string& name, unsigned threads) {
    return run(read_study(text, name), threads);
  });
}

}  // namespace wormdrive
