// The part of the module for drives that are stepped.
#include <cstring>

#include <fmt/format.h>

#include "bindings/python/module.hpp"
#include "bindings/python/numpy_table.hpp"
#include "description/diagnostics.hpp"
#include "simulation/stepping/stepped_drives.hpp"

namespace py = pybind11;

namespace wormdrive {
namespace {

/// In the order of State in wormdrive/stepping.py.
py::tuple numbers(const StepState& s) {
  return py::make_tuple(s.t, s.at.theta_g, s.at.omega_g, s.at.alpha_g, s.at.tau_m, s.at.tau_l, s.at.normal_force,
                        sign(s.at.mode.motion), sign(s.at.mode.flank), s.theta_w, s.omega_w);
}

py::dict by_name(const std::array<long, event_kind_count>& events) {
  py::dict all;
  for (const EventKind kind : event_kinds) all[py::str(name(kind))] = events[static_cast<std::size_t>(kind)];
  return all;
}

py::bytes packed(const std::vector<double>& list) {
  return {reinterpret_cast<const char*>(list.data()), list.size() * sizeof(double)};
}
std::vector<double> unpacked(const py::bytes& packed) {
  const std::string_view bytes = packed;
  std::vector<double> list(bytes.size() / sizeof(double));
  if (!list.empty()) std::memcpy(list.data(), bytes.data(), list.size() * sizeof(double));
  return list;
}

/// The snapshots of all drives one behind the other, each with its length before it.
py::bytes snapshot_of(const SteppedDrives& drives) {
  std::vector<double> all;
  for (std::size_t k = 0; k < drives.size(); ++k) {
    const std::vector<double> one = drives.snapshot(k);
    all.push_back(static_cast<double>(one.size()));
    all.insert(all.end(), one.begin(), one.end());
  }
  return packed(all);
}
void restore_all(SteppedDrives& drives, const py::bytes& snapshot) {
  const std::vector<double> all = unpacked(snapshot);
  std::vector<std::vector<double>> each;
  // that of a drive alone begins with its layout, which is less than any length
  if (!all.empty() && all[0] < 2.0) return drives.restore(std::vector(drives.size(), all));
  for (std::size_t at = 0; at < all.size();) {
    const double length = all[at++];
    if (!(length >= 0.0 && length <= static_cast<double>(all.size() - at))) reject({"snapshot"}, "is none of drives");
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(at);
    each.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(length));
    at += static_cast<std::size_t>(length);
  }
  drives.restore(each);
}

std::size_t place(const SteppedDrives& drives, py::ssize_t k) {
  const auto count = static_cast<py::ssize_t>(drives.size());
  if (k < -count || k >= count) throw py::index_error(fmt::format("drive {} of {}; the first is drive 0", k, count));
  return static_cast<std::size_t>(k < 0 ? k + count : k);
}

using Torques = py::array_t<double, py::array::c_style | py::array::forcecast>;

void step(SteppedDrives& drives, const Torques& torques, double dt) {
  if (torques.ndim() != 1) reject({"step"}, "torques must be an array of one axis, a torque for each drive");
  const std::span<const double> list(torques.data(), static_cast<std::size_t>(torques.size()));
  const py::gil_scoped_release others_may_run;
  drives.step(list, dt);
}

/// A member function of SteppedDrives that gives a span, as an array that looks there.
template <auto member>
py::array looking(const py::object& self) {
  return view((self.cast<const SteppedDrives&>().*member)(), self);
}

}  // namespace

void add_stepping(py::module_& m) {
  py::class_<SteppedDrive>(m, "Drive")
      .def(py::init([](const Scenario& scenario) { return make_stepped_drive(scenario); }))
      .def_property_readonly("halted", &SteppedDrive::halted)
      .def("step",
           [](SteppedDrive& drive, double torque, double dt) {
             {
               const py::gil_scoped_release others_may_run;
               drive.step(torque, dt);
             }
             return numbers(drive.state());
           })
      .def("state", [](const SteppedDrive& drive) { return numbers(drive.state()); })
      .def("columns",
           [](const SteppedDrive& drive) {
             const std::vector<std::string> names = drive.columns();
             const std::vector<double> values = drive.values();
             py::dict all;
             for (std::size_t k = 0; k < names.size(); ++k) all[py::str(names[k])] = values[k];
             return all;
           })
      .def("events", [](const SteppedDrive& drive) { return by_name(drive.events()); })
      .def("reset", &SteppedDrive::reset)
      .def("snapshot", [](const SteppedDrive& drive) { return packed(drive.snapshot()); })
      .def("restore", [](SteppedDrive& drive, const py::bytes& snapshot) { drive.restore(unpacked(snapshot)); });

  py::class_<SteppedDrives>(m, "Drives")
      .def(py::init([](const std::vector<std::shared_ptr<Scenario>>& scenarios) {
        std::vector<Scenario> all;
        for (const auto& scenario : scenarios) all.push_back(*scenario);
        return std::make_unique<SteppedDrives>(all);
      }))
      .def("__len__", &SteppedDrives::size)
      .def_property_readonly("in_lanes", &SteppedDrives::in_lanes)
      .def("time", &looking<&SteppedDrives::time>)
      .def("gear_angle", &looking<&SteppedDrives::gear_angle>)
      .def("gear_speed", &looking<&SteppedDrives::gear_speed>)
      .def("motion", &looking<&SteppedDrives::motion>)
      .def("flank", &looking<&SteppedDrives::flank>)
      .def("halted", &looking<&SteppedDrives::halted>)
      .def("step", &step)
      .def("state", [](const SteppedDrives& all, py::ssize_t k) { return numbers(all.state(place(all, k))); })
      .def("column",
           [](const SteppedDrives& all, const std::string& name) {
             const std::vector<double> values = all.values(name);
             return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data());
           })
      .def("events", [](const SteppedDrives& all, py::ssize_t k) { return by_name(all.events(place(all, k))); })
      .def("reset",
           [](SteppedDrives& all, const std::optional<std::vector<py::ssize_t>>& which) {
             if (!which) return all.reset();
             std::vector<std::size_t> places;
             for (const py::ssize_t k : *which) places.push_back(place(all, k));
             for (const std::size_t k : places) all.reset(k);
           })
      .def("snapshot", &snapshot_of)
      .def("restore", &restore_all);
}

}  // namespace wormdrive
