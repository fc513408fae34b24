#pragma once
#include <cmath>
#include <optional>
#include <string>

#include "control/lanes/trial.hpp"
#include "simulation/run_drive.hpp"

namespace wormdrive {

/// Whether torques that are held reach the mesh of a scenario as they are, and nothing but an arm under gravity loads
/// it.
bool has_lane_plant(const Scenario& scenario);
/// Whether a scenario can run in a lane: nothing between angle and torque but the sliding controller, nothing but the
/// mesh, dry bearings and an arm under gravity between torque and angle.
bool fits_lane(const Scenario& scenario);
/// Whether two scenarios take the same samples of the same reference, equally exact.
bool share_samples(const Scenario& a, const Scenario& b);

/// A scenario's run in a lane: whatever is not a sample without events.
class LaneRun {
 public:
  using Drive = WormDrive<double, GravityLoad>;

  /// The scenario must outlive it.
  explicit LaneRun(const Scenario& scenario);
  LaneRun(const LaneRun&) = delete;  // solver and run point into it
  LaneRun& operator=(const LaneRun&) = delete;

  /// False for a mode whose steps have no closed form.
  bool has_closed_form() const;
  bool estimate_is_aligned() const { return controller_.nominal().load_angle_offset == 0.0; }
  bool saturates() const { return !std::isinf(drive_.torque_limit()); }

  /// Goes to the first sample and takes up its lane. Throws SimulationFailure.
  void start(const Lane& lane);
  /// Goes on from a sample to the next under a torque [N m]. Throws SimulationFailure.
  void go_on(const Lane& lane, long sample, double t, double torque);
  void note(const Lane& lane, const ControlRecord& record);
  /// At the end; samples: how many were added to its sums.
  RunSummary finish(const Lane& lane, long samples);

 private:
  using Solver = TaylorSolver<Drive>;
  struct Torque;  ///< in the place of a controller

  void advance(Torque torque);
  void leave(LaneTrial<double>& trial) const;

  const Scenario& scenario_;
  RunListeners nobody_;
  Drive drive_;
  Solver solver_;
  DriveRun<Drive, Solver> run_;
  SlidingController controller_;
  ControlWatch watch_;
  Progress<Drive> progress_;
  long next_ = 0;  ///< sample up to which it has come alone
};

}  // namespace wormdrive
