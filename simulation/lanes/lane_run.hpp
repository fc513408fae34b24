#pragma once
#include <memory>

#include "control/lanes/trial.hpp"
#include "control/lanes/variant.hpp"
#include "events/taylor/tapes/series.hpp"
#include "simulation/run_scenario.hpp"

namespace wormdrive {

/// Whether torques that are held reach the mesh of a scenario as they are, and nothing but an arm under gravity loads
/// it.
bool has_lane_plant(const Scenario& scenario);
/// Whether a scenario may run in a lane: between angle and torque an encoder's scale, zero, counts and noise, the
/// sliding controller or the PID, and a delay of a sample; between torque and angle what has no states of its own,
/// where a torque that is held reaches the motor at once, before the next one is given, or with a lag.
bool fits_lane(const Scenario& scenario);
/// Whether two scenarios take the same samples of the same reference, equally exact.
bool share_samples(const Scenario& a, const Scenario& b);

/// A scenario's run in a lane: whatever is not a sample without events.
class LaneRun {
 public:
  virtual ~LaneRun() = default;

  /// What the run has in common with others of its batch; ideal where it needs no more.
  virtual LaneVariant variant() const = 0;
  /// Whether its load is estimated at the angle of the gear.
  virtual bool estimate_is_aligned() const = 0;
  /// Whether its encoder counts, is noisy, or its zero is off.
  virtual bool is_rough() const = 0;
  /// Whether its samples see an older angle.
  virtual bool is_late() const = 0;
  virtual bool is_noisy() const = 0;
  virtual bool is_disturbed() const = 0;
  /// The operations on its tape; nullptr where its steps have closed forms.
  virtual const TapeCode* tape() = 0;
  /// Where the numbers of its tape go, in its mode and in that across the switching surface, those of a register's
  /// trials side by side, the first of its own there; its lane takes part while its operations are these.
  virtual void use_tape(const TapeCode& code, double* numbers, double* across, int lanes) = 0;
  /// The section of a table on its tape for an argument.
  virtual SectionOf<double> section(int table, double x) = 0;
  /// Puts the noise of its encoder [rad] and what disturbs its shaft [N m] at samples in [first, end) there, where that
  /// is not null; every sample once and in order.
  virtual void draw(long first, long end, std::size_t stride, double* noise, double* disturbance) = 0;

  /// Goes to the first sample and takes up its lane. Throws SimulationFailure.
  virtual void start(const Lane& lane) = 0;
  /// Goes on from a sample to the next under a torque and what disturbs the shaft [N m]. Throws SimulationFailure.
  virtual void go_on(const Lane& lane, long sample, double t, double torque, double disturbance) = 0;
  virtual void note(const Lane& lane, const ControlRecord& record) = 0;
  /// At the end; samples: how many were added to its sums.
  virtual RunSummary finish(const Lane& lane, long samples) = 0;
};

/// The run of a scenario, which must outlive it; nothing where it does not fit into a lane.
std::unique_ptr<LaneRun> lane_run(const Scenario& scenario);

}  // namespace wormdrive
