#include "output/run_file.hpp"

#include <chrono>
#include <utility>

#include <fmt/format.h>

#include "output/hdf5/read_ahead.hpp"
#include "output/run_columns.hpp"

namespace wormdrive {

RunFile::RunFile(const std::string& path, const Provenance& provenance, Axis axis, RunContents contents,
                 Replace replace)
    : file_(path, provenance.kind, replace), contents_(std::move(contents)) {
  write_provenance(file_.file(), provenance);
  trajectory_.emplace(file_.file(), "trajectory", descriptions(trajectory_columns(contents_), axis),
                      contents_.expected_rows);
  events_.emplace(file_.file(), "events", descriptions(event_columns(contents_), axis), contents_.expected_rows);
  if (contents_.controlled)
    controller_.emplace(file_.file(), "controller", descriptions(controller_columns(), axis), contents_.expected_rows);
  file_.flush();
  flushed_ = Clock::now();
}

void RunFile::append(const Trajectory& part) {
  trajectory_->append(values(trajectory_columns(contents_), part.rows));
  events_->append(values(event_columns(contents_), part.events));
  // HDF5 writes how long a column is before it writes where the data are: killed between the two, the last rows are
  // lost. Flushing after every portion, one kill in a hundred hit these 50 us; now it is one in ten thousand.
  if (Clock::now() - flushed_ < std::chrono::seconds(1)) return;
  file_.flush();
  flushed_ = Clock::now();
}

void RunFile::append(const std::vector<ControlRecord>& samples) {
  if (controller_) controller_->append(values(controller_columns(), samples));
}

void RunFile::describe(const ControlSummary& summary) {
  const hid_t group = controller_->group();
  for_each_field<Metrics>([&](const auto& field) {
    if (summary.has(field.member)) write_attribute(group, std::string(field.name), summary.metrics.*field.member);
  });
  if (!summary.lemma) return;
  write_attribute(group, "layer_reached", summary.lemma->reached());
  for (const Violation& v : summary.lemma->violations()) {
    const std::string name(v.name);
    write_attribute(group, name + "_violations", std::int64_t{v.count});
    write_attribute(group, name + "_first", v.first);
    write_attribute(group, name + "_worst", v.worst);
    write_attribute(group, name + "_limit", v.limit);
  }
}

void RunFile::finish(const std::string& solver, const SolverStatistics& statistics) {
  const hid_t file = file_.file();
  write_attribute(file, "solver", solver);
  write_attribute(file, "solver_steps", std::int64_t{statistics.steps});
  write_attribute(file, "solver_evaluations", std::int64_t{statistics.evaluations});
  write_attribute(file, "solver_jacobians", std::int64_t{statistics.jacobians});
  write_attribute(file, "solver_error_test_failures", std::int64_t{statistics.error_test_failures});
  write_attribute(file, "solver_guard_evaluations", std::int64_t{statistics.guard_evaluations});
  write_attribute(file, "solver_restarts", std::int64_t{statistics.restarts});
  trajectory_.reset();
  events_.reset();
  controller_.reset();
  file_.finish();
}

std::string read_stored_scenario(const std::string& path) {
  read_ahead(path);
  const Hdf5Handle file = open_hdf5(path);
  try {
    return read_text_attribute(file, "scenario");
  } catch (const OutputFault& fault) {
    throw OutputFault(std::string("it is not a wormdrive result: ") + fault.what());
  }
}

}  // namespace wormdrive
