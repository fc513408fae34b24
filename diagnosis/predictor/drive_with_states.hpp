#pragma once
#include <utility>

#include "core/states/starting_state.hpp"
#include "diagnosis/predictor/flight.hpp"
#include "diagnosis/predictor/restitution.hpp"
#include "diagnosis/rules/noise.hpp"
#include "simulation/stepping/sampled_drive.hpp"

namespace wormdrive {

/// A drive whose effects have states, or whose inertia depends on the angle, as the predictor follows it. What a
/// recording does not show, as a current or a temperature, goes on from sample to sample as the model has it. Its teeth
/// are rigid and have no gap.
class DriveWithStates {
 public:
  using Drive = SampledDrive::Drive;
  using Instant = Drive::Instant;
  struct State {
    Instant now;
  };

  DriveWithStates(Drive drive, double /*gap*/, double /*compliance*/, const Restitution&)
      : sampled_(std::move(drive), rules::predictor_tolerance) {}

  Drive& drive() { return sampled_.drive(); }
  const Drive& drive() const { return sampled_.drive(); }
  /// What the gear's encoder shows [rad].
  double measured_angle(const State& s) const { return drive().measured_angle(s.now); }
  bool at_rest(const State& s) const { return s.now.mode.motion == Motion::stuck; }
  /// The worm, counted at the gear.
  ShaftState worm(const State& s) const {
    const Transmission<double> turned = drive().effects().transmission(s.now.x[0]);
    return {turned.angle, turned.slope * s.now.x[1]};
  }

  /// The state in which the gear stands here; effects start with it.
  State at(double t, const ShaftState& gear) const {
    State s;
    s.now.t = t;
    s.now.x = starting_state(drive(), {gear.angle, gear.speed}, t);
    return s;
  }
  State at(double t, const ShaftState& gear, const ShaftState& /*worm*/) const { return at(t, gear); }

  /// Moves the gear: what an observer finds out.
  void shift(State& s, double angle, double speed) const {
    s.now.x[0] += angle;
    s.now.x[1] += speed;
  }

  /// Runs to an end over which inputs that are not known beforehand are held.
  void run(State& s, double end) { sampled_.run(s.now, end, rules::most_events_of_a_sample); }

 private:
  SampledDrive sampled_;
};

}  // namespace wormdrive
