#pragma once
#include <optional>

#include "diagnosis/candidates/magnitudes.hpp"
#include "diagnosis/diagnosis.hpp"
#include "diagnosis/inference/selection.hpp"
#include "diagnosis/verdict/learned_terms.hpp"

namespace wormdrive {

/// Decides what a diagnosis may claim, from its causes, what remains and the gain of prediction; fills verdict,
/// classes and sentence, and withdraws names that the data do not bear out.
void judge(Diagnosis& diagnosis, const Selection& selection, const std::vector<Candidate>& all,
           const Magnitudes& sizes);

/// The error ahead that the sentence tells of, null if there is none.
const PredictionError* reported_error(const Diagnosis& diagnosis);

/// What no test of the residuals saw, for it took it for outliers, but the error ahead shows; nothing if that is noise.
std::optional<Remainder> error_above_noise(const Diagnosis& diagnosis);

/// Whether stated parameters that move within their tolerances lower the error ahead by more than is of no account.
bool calibration_matters(const Diagnosis& diagnosis);

/// Whether a gap is among the causes: teeth that bounce from flank to flank, which no model follows far.
bool impacts(const Diagnosis& diagnosis);

/// The reported error before and after, as a sentence to be added.
std::string gain_sentence(const Diagnosis& diagnosis);

/// What a map of what is left does, to be added to the sentence.
std::string learned_sentence(const LearnedTerms& learned, Axis axis);

/// Whether so much of the motor's torque, rms, is noise that no cause can be named. Teeth that bounce from flank to
/// flank are different, for a shock turns on what nobody can measure.
bool needs_much_noise(const Diagnosis& diagnosis, double torque);

/// Whether that much is noise, and no horizon is predicted clearly better than without any torque: such a model does
/// not know the motion.
bool noise_dominated(const Diagnosis& diagnosis, double torque);

/// The class that an effect belongs to, null if it is told from all others.
const std::vector<std::string>* class_of(const Diagnosis& diagnosis, std::string_view effect);

/// An id as it is read: "worm viscous".
std::string in_words(std::string id);

/// Parts as they are listed, the last one after "and" or "or": "a, b and c".
std::string joined(const std::vector<std::string>& parts, std::string_view last);

/// "mesh friction: change 0.0150 +- 0.0010"
std::string phrase(const EstimatedEffect& effect, Axis axis);

}  // namespace wormdrive
