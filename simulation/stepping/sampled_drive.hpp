#pragma once
#include <memory>

#include "core/load.hpp"
#include "core/worm_drive.hpp"

namespace wormdrive {

/// A drive whose effects have states, or whose inertia depends on the angle, that is run from sample to sample by the
/// solver "taylor", event by event; who runs it may move its state in between.
class SampledDrive {
 public:
  using Drive = WormDrive<double, SummedLoad, true>;
  using Instant = Drive::Instant;

  /// tolerance: relative, and of angle and speed a hundredth of it absolute [rad, rad/s].
  SampledDrive(Drive drive, double tolerance);
  ~SampledDrive();
  SampledDrive(const SampledDrive&) = delete;
  SampledDrive& operator=(const SampledDrive&) = delete;

  Drive& drive() { return drive_; }
  const Drive& drive() const { return drive_; }
  /// Runs to an end [s] under inputs that are those of the time. Throws SolverFault where no motion goes on, or has
  /// more events than these.
  void run(Instant& now, double end, int most_events);

 private:
  struct Solver;

  Drive drive_;
  std::unique_ptr<Solver> solver_;
};

}  // namespace wormdrive
