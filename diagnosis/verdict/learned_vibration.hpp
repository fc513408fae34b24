#pragma once
#include <optional>

#include "diagnosis/candidates/magnitudes.hpp"
#include "diagnosis/fitting/hypothesis.hpp"

namespace wormdrive {

/// A torque on the worm that comes back in time: amplitude cos(phase), amplitude sin(phase) [N m] and frequency [Hz].
struct LearnedVibration {
  double in_phase{}, in_quadrature{}, frequency{};
};

/// The strongest line that a hypothesis leaves, as a vibration with its numbers fitted; nothing where there is none,
/// the drive has one, or the error ahead falls by less than 5 % or no more than by chance. h: gets it, with its numbers
/// free.
std::optional<LearnedVibration> learned_vibration(const Evaluation& evaluation, Hypothesis& h, const Magnitudes& sizes);

/// Adds one to a hypothesis, with its numbers free. To be evaluated.
void add_vibration(Hypothesis& h, const LearnedVibration& vibration, const Magnitudes& sizes);

}  // namespace wormdrive
