#include "bindings/python/module.hpp"
#include "bindings/python/numpy_table.hpp"
#include "bindings/python/signals.hpp"
#include "bindings/python/sweep_result.hpp"
#include "sweep/load_study.hpp"
#include "sweep/threads.hpp"

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
    const std::vector<double>& values = result.column(k);
    list.append(described(result.columns()[k],
                          py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data(), self)));
  }
  return list;
}

}  // namespace

void add_sweep(py::module_& m) {
  py::class_<SweepResult>(m, "Sweep")
      .def_property_readonly("title", [](const SweepResult& r) { return r.study().title; })
      .def("trials", &trials)
      .def("reasons", &SweepResult::reasons)
      .def(
          "write",
          [](const SweepResult& r, const std::string& path, const std::string& command_line, std::size_t referee) {
            const py::gil_scoped_release others_may_run;
            r.write(path, command_line, referee, threads_for(0));
          },
          py::arg("path"), py::arg("command_line"), py::arg("referee"));
  m.def("sweep_file", [](const std::string& path, unsigned threads) { return run(load_study(path), threads); });
  m.def("sweep_text", [](const std::string& text, const std::string& name, unsigned threads) {
    return run(read_study(text, name), threads);
  });
}

}  // namespace wormdrive
