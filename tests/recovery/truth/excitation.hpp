#pragma once
#include <cstdint>
#include <vector>

#include "recovery/truth/recording.hpp"

namespace truth {

/// The motion that is asked for, sample by sample: angle, speed and acceleration [rad, s].
struct EventSequence {
  double period = 1e-3;
  std::vector<double> angle, speed, acceleration;
};

/// A motion of 24 s that shows everything: a slow sweep, a multisine, random steps, a sine of 1.5 Hz, holds of three
/// lengths each followed by a ramp, 20 Hz, the sweep again; its centre wanders over +-2.4 rad, where the load changes
/// sign. The seed draws phases and steps. A shorter duration compresses the plan, not the motions.
EventSequence rich_course(std::uint64_t seed, double duration = 24.0, double period = 1e-3);

/// One sine, a motion that shows little.
EventSequence slow_course(double amplitude, double frequency, double duration);

/// A course through angles that somebody else asks for, one per period; speeds and accelerations are their differences.
EventSequence course_through(std::vector<double> angle, double period = 1e-3);

/// Proportional-derivative control of the course, fed forward with what the data sheet says of inertia, load and
/// friction; the gains keep every hidden effect stable, and fall with the rate of slow controllers.
Law follow(EventSequence course, const Sheet& sheet);

}  // namespace truth
