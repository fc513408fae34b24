#include "simulation/stepping/stepped_drives.hpp"

#include <algorithm>
#include <limits>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "control/lanes/step_batch.hpp"
#include "description/diagnostics.hpp"
#include "events/simulation_failure.hpp"

namespace wormdrive {
namespace {

constexpr std::size_t register_bytes = 64;  ///< of the widest kind

bool same_accuracy(const SolverSettings& a, const SolverSettings& b) {
  return a.relative_tolerance == b.relative_tolerance && a.absolute_tolerance == b.absolute_tolerance &&
         a.max_step == b.max_step;
}

/// Whether these drives may share registers.
bool fit_registers(const std::vector<std::unique_ptr<SteppedDrive>>& drives, const std::vector<Scenario>& scenarios) {
  for (std::size_t k = 0; k < drives.size(); ++k)
    if (!drives[k]->lane_motion() ||
        !same_accuracy(scenarios[0].run.solver_settings(), scenarios[k].run.solver_settings()))
      return false;
  return true;
}

}  // namespace

/// What the kernels have of the drives beside angles and speeds.
class SteppedDrives::Registers {
 public:
  Registers(LaneKind kind, std::size_t drives, const SolverSettings& settings)
      : kind_(kind),
        lanes_(lanes_of(kind)),
        count_((static_cast<int>(drives) + lanes_ - 1) / lanes_),
        fields_(static_cast<double*>(
            ::operator new (places() * lane_drive_fields * sizeof(double), std::align_val_t{register_bytes}))),
        torque_(places()),
        alive_(static_cast<std::size_t>(count_)),
        accuracy_(settings),
        longest_(settings.max_step) {
    std::fill_n(fields_.get(), places() * lane_drive_fields, 0.0);
  }

  std::size_t places() const { return static_cast<std::size_t>(count_) * static_cast<std::size_t>(lanes_); }
  void write(std::size_t k, const SteppedDrive& drive) {
    write_lane(fields_.get(), lanes_, static_cast<int>(k), {*drive.lane_motion(), drive.arm_offset()});
  }
  void live(std::size_t k, bool goes_on) {
    const std::size_t lanes = static_cast<std::size_t>(lanes_);
    const unsigned bit = 1U << k % lanes;
    alive_[k / lanes] = goes_on ? alive_[k / lanes] | bit : alive_[k / lanes] & ~bit;
  }
  double torque(std::size_t k) const { return torque_[k]; }
  void step(std::span<const double> torques, double h, SteppedDrives& owner) {
    std::copy(torques.begin(), torques.end(), torque_.begin());
    take_step(kind_, {.theta = owner.theta_.data(),
                      .omega = owner.omega_.data(),
                      .torque = torque_.data(),
                      .drives = fields_.get(),
                      .registers = count_,
                      .alive = alive_.data(),
                      .step = h <= longest_ ? h : std::numeric_limits<double>::quiet_NaN(),
                      .accuracy = accuracy_,
                      .owner = &owner,
                      .go_on =
                          [](void* drives, int k, double torque) {
                            static_cast<SteppedDrives*>(drives)->go_on(static_cast<std::size_t>(k), torque);
                          },
                      .sine_and_cosine = [](double angle) { return wormdrive::sine_and_cosine(angle); }});
  }

 private:
  struct Free {
    void operator()(double* memory) const { ::operator delete (memory, std::align_val_t{register_bytes}); }
  };
  LaneKind kind_;
  int lanes_, count_;
  std::unique_ptr<double, Free> fields_;
  std::vector<double> torque_;
  std::vector<unsigned> alive_;
  TaylorAccuracy accuracy_;
  double longest_;  ///< step [s]
};

SteppedDrives::SteppedDrives(const std::vector<Scenario>& scenarios, LaneKind kind) {
  for (const Scenario& scenario : scenarios) drives_.push_back(make_stepped_drive(scenario));
  if (drives_.empty()) reject({"drives"}, "there must be at least one");
  std::size_t places = drives_.size();
  if (fit_registers(drives_, scenarios)) {
    registers_ = std::make_unique<Registers>(kind, drives_.size(), scenarios[0].run.solver_settings());
    places = registers_->places();
  }
  time_.resize(drives_.size());
  began_.resize(drives_.size());
  theta_.resize(places);
  omega_.resize(places);
  motion_.resize(drives_.size());
  flank_.resize(drives_.size());
  halted_.resize(drives_.size());
  behind_.resize(drives_.size());
  for (std::size_t k = 0; k < size(); ++k) show(k);
}
SteppedDrives::~SteppedDrives() = default;

void SteppedDrives::step(std::span<const double> torques, double dt) {
  if (torques.size() != size())
    reject({"step"}, fmt::format("{} torques for {} drives; state one for each", torques.size(), size()));
  for (std::size_t k = 0; k < size(); ++k)
    if (!std::isfinite(torques[k]))
      reject({"step"}, fmt::format("torque[{}] = {} must be a finite number", k, torques[k]));
  halts_ = 0;
  if (registers_)
    step_lanes(torques, dt);
  else
    step_each(torques, dt);
  if (halts_ == 0) return;
  const std::string others = halts_ > 1 ? fmt::format("; {} more halted in this step", halts_ - 1) : "";
  throw SimulationFailure(failure_ + others);
}

void SteppedDrives::step_each(std::span<const double> torques, double dt) {
  for (std::size_t k = 0; k < size(); ++k) reject_impossible_step(0.0, dt, drives_[k]->clock());
  for (std::size_t k = 0; k < size(); ++k) {
    if (halted_[k]) continue;
    try {
      drives_[k]->step(torques[k], dt);
    } catch (const SimulationFailure& halt) {
      note_halt(k, halt.what());
    }
    show(k);
  }
}

void SteppedDrives::step_lanes(std::span<const double> torques, double dt) {
  reject_impossible_step(0.0, dt, clock_);
  const StepClock next = clock_.after(dt);
  from_ = clock_.now();
  until_ = next.now();
  std::fill(behind_.begin(), behind_.end(), std::int8_t{1});
  registers_->step(torques, until_ - from_, *this);
  clock_ = next;
  for (std::size_t k = 0; k < size(); ++k)
    if (!halted_[k]) time_[k] = until_ - began_[k];
}

void SteppedDrives::go_on(std::size_t k, double torque) {
  SteppedDrive& drive = *drives_[k];
  drive.take_up(time_[k], theta_[k], omega_[k]);
  behind_[k] = 0;
  try {
    drive.go_on(torque, until_ - began_[k]);
    registers_->write(k, drive);
  } catch (const SimulationFailure& halt) {
    drive.halt(halt.what());
    note_halt(k, halt.what());
    registers_->live(k, false);
    time_[k] = drive.state().t;
  }
  const StepPlace place = drive.place();
  theta_[k] = place.theta_g;
  omega_[k] = place.omega_g;
  motion_[k] = static_cast<std::int8_t>(sign(place.mode.motion));
  flank_[k] = static_cast<std::int8_t>(sign(place.mode.flank));
}

void SteppedDrives::note_halt(std::size_t k, const std::string& why) {
  halted_[k] = 1;
  if (++halts_ == 1) failure_ = fmt::format("drive {}: {}", k, why);
}

void SteppedDrives::show(std::size_t k) {
  const SteppedDrive& drive = *drives_[k];
  const StepPlace place = drive.place();
  time_[k] = drive.clock().now();
  theta_[k] = place.theta_g;
  omega_[k] = place.omega_g;
  motion_[k] = static_cast<std::int8_t>(sign(place.mode.motion));
  flank_[k] = static_cast<std::int8_t>(sign(place.mode.flank));
  halted_[k] = drive.halted() ? 1 : 0;
  if (!registers_) return;
  behind_[k] = 0;
  registers_->write(k, drive);
  registers_->live(k, !halted_[k]);
}

SteppedDrive& SteppedDrives::synchronous(std::size_t k) const {
  SteppedDrive& drive = *drives_[k];
  if (!registers_ || halted_[k]) return drive;
  if (std::exchange(behind_[k], std::int8_t{0})) {
    drive.take_up(time_[k], theta_[k], omega_[k]);
    drive.tell(from_ - began_[k], registers_->torque(k));
  }
  drive.set_clock(began_[k] == 0.0 ? clock_ : StepClock{time_[k], 0.0, 0.0});
  return drive;
}

StepState SteppedDrives::state(std::size_t k) const { return synchronous(k).state(); }
std::vector<double> SteppedDrives::values(const std::string& column) const {
  std::vector<double> list;
  for (std::size_t k = 0; k < size(); ++k) list.push_back(synchronous(k).value(column));
  return list;
}
std::array<long, event_kind_count> SteppedDrives::events(std::size_t k) const { return drives_[k]->events(); }

void SteppedDrives::reset(std::size_t k) {
  drives_[k]->reset();
  began_[k] = clock_.now();
  show(k);
}
void SteppedDrives::reset() {
  clock_ = {};
  for (std::size_t k = 0; k < size(); ++k) reset(k);
}

std::vector<double> SteppedDrives::snapshot(std::size_t k) const { return synchronous(k).snapshot(); }

void SteppedDrives::restore(std::size_t k, std::span<const double> snapshot) {
  drives_[k]->restore(snapshot);
  began_[k] = clock_.now() - drives_[k]->clock().now();
  show(k);
}

void SteppedDrives::restore(std::span<const std::vector<double>> snapshots) {
  if (snapshots.size() != size())
    reject({"snapshot"}, fmt::format("is of {} drives, not of {}", snapshots.size(), size()));
  for (std::size_t k = 0; k < size(); ++k) drives_[k]->reject_foreign(snapshots[k]);
  clock_ = SteppedDrive::clock_of(snapshots[0]);  // drives that were stepped together have one clock again
  for (std::size_t k = 0; k < size(); ++k) restore(k, snapshots[k]);
}

}  // namespace wormdrive
