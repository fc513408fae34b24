#pragma once
#include <utility>

#include "core/motor_input.hpp"
#include "core/numbers/queue.hpp"

namespace wormdrive {

/// What the inputs of a drive know of the past, as numbers: a fresh drive that recall() tells them has the same inputs
/// to the same bits.
struct InputMemory {
  struct Command {
    double t, torque;
  };
  double entered = 0.0;       ///< when inputs were last frozen to their pieces [s] ...
  double held_then = 0.0;     ///< ... and what the motor was told then [N m]
  Command held{};             ///< the latest command that has arrived, and when it was given
  double frozen = 0.0;        ///< when the lag began its present piece [s] ...
  double lagged = 0.0;        ///< ... and its torque then [N m]
  Queue<Command> on_the_way;  ///< given and not arrived: behind a delay
};

/// A drive whose motor is told its torque step by step, and which remembers what a copy has to be told. Its motor has
/// no signal of its own.
template <class Drive>
class Commanded : public Drive {
 public:
  explicit Commanded(Drive drive)
      : Drive(std::move(drive)),
        late_(Drive::effects().delay()),
        lag_(Drive::effects().lag()),
        lagged_(Signal{}, Drive::torque_limit(), late_, lag_) {}

  void enter(double t) {
    freeze(t);
    lagged_.enter(t);
    memory_.entered = t;
    while (!memory_.on_the_way.empty() && memory_.on_the_way.front().t + late_ <= t) {
      memory_.held = memory_.on_the_way.front();
      memory_.on_the_way.pop();
    }
    memory_.held_then = memory_.held.torque;
    Drive::enter(t);
  }
  bool command(double t, double torque) {
    if (late_ > 0.0) {
      memory_.on_the_way.push({t, torque});
    } else {
      freeze(t);
      memory_.held = {t, torque};
    }
    if (remembers()) lagged_.command(t, torque);
    return Drive::command(t, torque);
  }
  /// The next knot is kept for the step behind the one that found it.
  double next_knot(double t) const { return knot_ = Drive::next_knot(t); }
  double knot() const { return knot_; }

  void rewind() {
    Drive::rewind();
    lagged_.rewind();
    started_ = false;
    memory_ = {};
  }
  const InputMemory& memory() const { return memory_; }
  void recall(const InputMemory& past, double knot) {
    rewind();
    if (late_ > 0.0)
      recall_delayed(past);
    else
      recall_direct(past);
    for (const auto& [t, torque] : past.on_the_way) command(t, torque);
    memory_ = past;
    knot_ = knot;
  }

 private:
  /// What decays over so many time constants is zero in the arithmetic of portable::exp, not only small.
  static constexpr double forgotten = 1000.0;

  bool remembers() const { return late_ > 0.0 || lag_ > 0.0; }
  void freeze(double t) {
    memory_.frozen = t;
    if (lag_ > 0.0) memory_.lagged = std::exchange(started_, true) ? lagged_(t) : 0.0;
  }
  void recall_direct(const InputMemory& past) {
    if (lag_ > 0.0)
      command(past.frozen - forgotten * lag_, past.lagged);  // reached long ago, the torque is exactly this one
    else
      command(past.entered, past.held_then);
    enter(past.entered);
    command(past.frozen, past.held.torque);
  }
  void recall_delayed(const InputMemory& past) {
    if (lag_ > 0.0) {
      const double long_ago = past.entered - 2.0 * late_ - forgotten * lag_;
      command(long_ago, past.lagged);
      enter(long_ago + late_);
    }
    command(past.entered - 2.0 * late_, past.held.torque);
    enter(past.entered);
  }

  double late_, lag_;
  MotorInput<double> lagged_;  ///< the motor's own, whose torque the drive does not show
  bool started_ = false;       ///< it has had a piece
  InputMemory memory_;
  mutable double knot_ = 0.0;
};

}  // namespace wormdrive
