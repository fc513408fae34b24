#pragma once
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/numbers/sine_cosine.hpp"
#include "description/scenario.hpp"
#include "events/taylor/nominal/driven.hpp"
#include "output/run_columns.hpp"
#include "simulation/stepping/step_clock.hpp"

namespace wormdrive {

/// What a stepped drive shows: a row of a run and the worm, which turns with the gear where the teeth are rigid.
struct StepState {
  double t;  ///< [s]
  Observation at;
  double theta_w, omega_w;  ///< of the worm [rad, rad/s]
};

/// Angle, speed and mode alone, for whoever asks after every step.
struct StepPlace {
  double theta_g, omega_g;
  Mode mode;
};

/// A drive that others step inside a loop of their own, under a motor torque that is held during a step. It goes by the
/// loop and the solver of run_scenario(), and to the bits of a run whose motor torque is a table of the same steps.
class SteppedDrive {
 public:
  virtual ~SteppedDrive() = default;
  SteppedDrive(const SteppedDrive&) = delete;  // solver and loop point into it
  SteppedDrive& operator=(const SteppedDrive&) = delete;

  /// Goes on by dt [s] under a motor torque [N m], through all events on the way. Throws InputFault for an argument
  /// that is none, SimulationFailure where the drive cannot go on: it then stands where it halted until reset() or
  /// restore().
  void step(double torque, double dt);
  double time() const { return clock_.now(); }
  const StepClock& clock() const { return clock_; }
  virtual StepState state() const = 0;
  /// The names of all columns that a trajectory of this drive has, those of its effects' states among them.
  std::vector<std::string> columns() const;
  /// What they show now, in their order.
  std::vector<double> values() const;
  /// What one of them shows now. Throws InputFault where there is none of that name.
  double value(const std::string& column) const;
  /// Why the drive could not go on, if it could not.
  const std::optional<std::string>& halted() const { return halted_; }
  virtual StepPlace place() const = 0;
  /// By EventKind, since the start.
  virtual std::array<long, event_kind_count> events() const = 0;

  /// Starts again, as the scenario states.
  void reset();
  /// All that changes, as numbers: the same bits follow from them, in this process or another one.
  std::vector<double> snapshot() const;
  /// Goes back to a snapshot of this drive or of one with the same scenario. Throws InputFault.
  void restore(std::span<const double> snapshot);
  /// Throws what restore() throws for a snapshot that is none, or of another scenario.
  void reject_foreign(std::span<const double> snapshot) const;
  /// The clock at a snapshot that is one.
  static StepClock clock_of(std::span<const double> snapshot) { return {snapshot[2], snapshot[3], snapshot[4]}; }

  // ---- for steps that a register of drives makes at once ---------------------------------------------------------

  /// The present mode under a held torque where its steps have a closed form, without motion at rest; nothing where the
  /// drive is not one for a lane.
  virtual std::optional<DrivenMotion> lane_motion() const { return std::nullopt; }
  virtual SineAndCosine arm_offset() const { return {0.0, 1.0}; }
  /// Takes up what a lane has come to in an unchanged mode, at a time [s].
  virtual void take_up(double t, double theta_g, double omega_g) = 0;
  /// Tells the torque [N m] that a lane has held from a time on [s].
  virtual void tell(double t, double torque) = 0;
  /// Goes on to a time [s].
  virtual void go_on(double torque, double until) = 0;
  void set_clock(const StepClock& clock) { clock_ = clock; }
  void halt(std::string why) { halted_ = std::move(why); }

 protected:
  SteppedDrive() = default;
  virtual void begin() = 0;
  virtual void write(std::vector<double>& numbers) const = 0;
  virtual bool read(std::span<const double> numbers) = 0;

 private:
  friend std::unique_ptr<SteppedDrive> make_stepped_drive(const Scenario& scenario);
  StepClock clock_;
  std::optional<std::string> halted_;
  double digest_ = 0.0;  ///< of the scenario, for snapshots to be known by
  std::vector<RunColumn<Row>> columns_;
};

/// Throws InputFault unless torque [N m] and dt [s] make a step that time resolves.
void reject_impossible_step(double torque, double dt, const StepClock& clock);

/// The drive of a scenario, to be stepped. Throws InputFault where the scenario is none for a run.
std::unique_ptr<SteppedDrive> make_stepped_drive(const Scenario& scenario);

/// What a scenario states and stepping has no use for, one sentence each.
std::vector<std::string> set_aside(const Scenario& scenario);

/// The scenario as it is stepped: without all that.
Scenario plant_of(Scenario scenario);

}  // namespace wormdrive
