#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "control/lanes/kind.hpp"
#include "simulation/stepping/stepped_drive.hpp"

namespace wormdrive {

/// Drives that are stepped together, each under a torque of its own. Those that differ in numbers alone, solved by
/// power series, moved by nothing but motor, bearings and an arm under gravity, share registers; each gets the bits
/// that it would get alone. A step without an event or a delay allocates nothing.
class SteppedDrives {
 public:
  /// One drive of each scenario, at least one. Throws InputFault.
  explicit SteppedDrives(const std::vector<Scenario>& scenarios, LaneKind kind = widest_lanes());
  ~SteppedDrives();
  SteppedDrives(const SteppedDrives&) = delete;
  SteppedDrives& operator=(const SteppedDrives&) = delete;

  std::size_t size() const { return drives_.size(); }
  bool in_lanes() const { return registers_ != nullptr; }

  /// All go on by dt [s], each under its torque [N m]. Throws InputFault before any has moved. A drive that halts stays
  /// where it halted and holds back no other; SimulationFailure then tells of it when all have made their step.
  void step(std::span<const double> torques, double dt);

  // Of every drive, in their order; the memory stays where it is.
  std::span<const double> time() const { return {time_.data(), size()}; }         ///< [s]
  std::span<const double> gear_angle() const { return {theta_.data(), size()}; }  ///< [rad]
  std::span<const double> gear_speed() const { return {omega_.data(), size()}; }  ///< [rad/s]
  std::span<const std::int8_t> motion() const { return {motion_.data(), size()}; }
  std::span<const std::int8_t> flank() const { return {flank_.data(), size()}; }
  std::span<const std::int8_t> halted() const { return {halted_.data(), size()}; }  ///< 1 where a drive has halted

  StepState state(std::size_t k) const;
  /// What a column of a trajectory shows of every drive, as of one alone.
  std::vector<double> values(const std::string& column) const;
  std::array<long, event_kind_count> events(std::size_t k) const;
  /// Starts one again, as its scenario states; the others go on.
  void reset(std::size_t k);
  void reset();
  std::vector<double> snapshot(std::size_t k) const;
  /// Takes one back to its snapshot; or all, and none where one snapshot is faulty.
  void restore(std::size_t k, std::span<const double> snapshot);
  void restore(std::span<const std::vector<double>> snapshots);

 private:
  class Registers;

  void step_each(std::span<const double> torques, double dt);
  void step_lanes(std::span<const double> torques, double dt);
  /// Lets one go on alone; what stops it stops no other.
  void go_on(std::size_t k, double torque);
  void note_halt(std::size_t k, const std::string& why);
  void show(std::size_t k);
  /// The drive with what its lane has come to.
  SteppedDrive& synchronous(std::size_t k) const;

  std::vector<std::unique_ptr<SteppedDrive>> drives_;
  std::vector<double> time_, theta_, omega_;
  std::vector<std::int8_t> motion_, flank_, halted_;
  std::unique_ptr<Registers> registers_;     ///< nothing where every drive goes alone
  StepClock clock_;                          ///< of all, in registers ...
  std::vector<double> began_;                ///< ... and what it showed at the start of each [s]
  double from_ = 0.0, until_ = 0.0;          ///< begin and end of the latest step on this clock [s]
  mutable std::vector<std::int8_t> behind_;  ///< 1 where a lane has gone on and the drive does not know
  long halts_ = 0;                           ///< in the present step ...
  std::string failure_;                      ///< ... and the first of them
};

}  // namespace wormdrive
