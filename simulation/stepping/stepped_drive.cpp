#include "simulation/stepping/stepped_drive.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/elastic/elastic_teeth.hpp"
#include "description/build.hpp"
#include "description/diagnostics.hpp"
#include "description/keys.hpp"
#include "description/rejection.hpp"
#include "description/toml/write_scenario.hpp"
#include "events/simulation_failure.hpp"
#include "simulation/lanes/lane_run.hpp"
#include "simulation/stepping/drive_stepper.hpp"
#include "simulation/write_run.hpp"

namespace wormdrive {
namespace {

/// 52 bits that two scenarios hardly share unless their drives are the same (Fowler, Noll and Vo's hash 1a).
double digest_of(Scenario plant) {
  plant.title.clear();
  plant.run.duration = 1.0;
  plant.run.report_interval.reset();
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : to_toml(plant)) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return static_cast<double>(hash >> 12);
}

constexpr double layout = 1.0;  ///< of the numbers of a snapshot
constexpr std::size_t header_numbers = 5;

[[noreturn]] void reject_snapshot(const std::string& what) { reject({"snapshot"}, what); }

}  // namespace

void reject_impossible_step(double torque, double dt, const StepClock& clock) {
  if (!std::isfinite(torque)) reject({"step"}, fmt::format("torque = {} must be a finite number", torque));
  if (!std::isfinite(dt) || dt <= 0.0)
    reject({"step"}, fmt::format("dt = {} s must be a finite number greater than 0", dt));
  if (const double t = clock.now(); !(clock.after(dt).now() > t))
    reject({"step"}, fmt::format("dt = {} s is less than time resolves at {} s; reset() starts at 0 again", dt, t));
}

void SteppedDrive::step(double torque, double dt) {
  reject_impossible_step(torque, dt, clock_);
  if (halted_) throw SimulationFailure(*halted_);
  const StepClock next = clock_.after(dt);
  try {
    go_on(torque, next.now());
  } catch (const SimulationFailure& halt) {
    halted_ = halt.what();
    throw;
  }
  clock_ = next;
}

void SteppedDrive::reset() {
  begin();
  clock_ = {};
  halted_.reset();
}

std::vector<std::string> SteppedDrive::columns() const {
  std::vector<std::string> names;
  for (const auto& column : columns_) names.push_back(column.description.name);
  return names;
}

std::vector<double> SteppedDrive::values() const {
  const StepState now = state();
  std::vector<double> list;
  for (const auto& column : columns_) list.push_back(column.value({now.t, now.at}));
  return list;
}

double SteppedDrive::value(const std::string& column) const {
  const auto found =
      std::find_if(columns_.begin(), columns_.end(), [&](const auto& c) { return c.description.name == column; });
  if (found == columns_.end())
    reject({"drive"}, fmt::format("has no column '{}'; it has {}", column, fmt::join(columns(), ", ")));
  const StepState now = state();
  return found->value({now.t, now.at});
}

std::vector<double> SteppedDrive::snapshot() const {
  if (halted_) reject_snapshot("the drive has halted and has no state to come back to; reset() or restore() it");
  std::vector<double> numbers{layout, digest_, clock_.base, clock_.length, clock_.count};
  write(numbers);
  return numbers;
}

void SteppedDrive::reject_foreign(std::span<const double> snapshot) const {
  if (snapshot.size() < header_numbers || snapshot[0] != layout)
    reject_snapshot("is none, or of another version of wormdrive");
  if (snapshot[1] != digest_) reject_snapshot("is of a drive with another scenario");
}

void SteppedDrive::restore(std::span<const double> snapshot) {
  reject_foreign(snapshot);
  if (!read(snapshot.subspan(header_numbers))) reject_snapshot("is damaged");
  clock_ = clock_of(snapshot);
  halted_.reset();
}

std::vector<std::string> set_aside(const Scenario& scenario) {
  const std::string torque = in_words_of(scenario.axis, "torque");
  std::vector<std::string> list;
  if (!scenario.motor.terms.empty())
    list.push_back(fmt::format("[motor.{0}] is not used: every step states the {0} of the motor", torque));
  if (scenario.control)
    list.push_back(fmt::format(
        "[controller], its reference, sensor and disturbance are not used: every step states the {} of the motor",
        torque));
  scenario.effects.for_each([&]<class E>(const std::optional<E>& effect) {
    if (effect && E::place == Place::sensor)
      list.push_back(
          fmt::format("[effect.{}] is not used: a step shows the drive, not what a sensor sees of it", E::id));
  });
  return list;
}

Scenario plant_of(Scenario scenario) {
  scenario.motor = {};
  scenario.control.reset();
  scenario.effects.for_each([]<class E>(std::optional<E>& effect) {
    if (E::place == Place::sensor) effect.reset();
  });
  return scenario;
}

std::unique_ptr<SteppedDrive> make_stepped_drive(const Scenario& scenario) {
  const Scenario plant = plant_of(scenario);
  if (const auto why = why_the_drive_cannot_run(plant)) reject({"drive"}, *why);
  const bool elastic = has_elastic_teeth(plant.effects);
  if (elastic && plant.run.solver == SolverKind::taylor)
    reject({"drive"}, "the solver \"taylor\" follows rigid drives only; set run.solver = \"cvode\"");
  auto drive = elastic                       ? make_compliant_stepper(plant)
               : plant.effects.have_states() ? make_stepper_with_states(plant)
                                             : with_drive_for_runs(plant, [&](auto& rigid) {
                                                 return stepper_of(std::move(rigid), plant, has_lane_plant(plant));
                                               });
  drive->digest_ = digest_of(plant);
  drive->columns_ = trajectory_columns(contents_of(plant));
  return drive;
}

}  // namespace wormdrive
