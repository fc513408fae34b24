#pragma once
#include <string>
#include <string_view>
#include <vector>

#include "diagnosis/candidates/coordinates.hpp"
#include "diagnosis/candidates/magnitudes.hpp"

namespace wormdrive {

/// Where a fit of a candidate starts.
struct CandidateStart {
  std::vector<double> values;      ///< of its coordinates
  std::vector<FieldValue> chosen;  ///< fields that are not fitted but tried out
};

/// An effect that leaves the very same data, and its field that shows the size.
struct Twin {
  std::string_view effect, field;
};

/// An effect of the catalogue as a possible cause: what a fit of it moves, and from where.
struct Candidate {
  std::string_view effect;
  std::vector<Coordinate> coordinates;
  std::vector<CandidateStart> starts;
  std::vector<double> far{};  ///< values of the first coordinate decades from what is stated, tried out as they are
  /// Where the effect has no derivative at no effect, its signature is what a start of its own does.
  bool finite = false;
  bool resizable = true;             ///< the first coordinate of a finite start may be scaled down to no effect
  bool either_sign = false;          ///< ... and beyond
  bool impacts = false;              ///< its likelihood is rough, and a restitution belongs to it
  double choices = 0.0;              ///< what trying out costs, as BIC
  std::string_view frees{};          ///< an effect whose tolerance does not hold beside this one
  std::vector<Twin> twins{};         ///< effects that no recording of this kind tells from it
  bool is_limit = false;             ///< it acts only beyond its first coordinate
  bool falls = false;                ///< friction falls with the speed, by a law whose shape is uncertain
  std::string_view limiting_case{};  ///< the effect that it becomes where its second coordinate is small

  bool rare = false;          ///< it shows at few moments
  bool alone = false;         ///< sought by itself only: beside others it is what they are together
  bool of_recording = false;  ///< a fault of the recording, not an effect of the drive

  /// Whether all its coordinates have a tolerance.
  bool toleranced = false;
};

/// Every effect that could be at work in a drive of this kind.
std::vector<Candidate> candidates(const Effects<double>& stated, const Magnitudes& sizes,
                                  const std::vector<Coordinate>& toleranced);

/// Takes a candidate out of effects: they have what the scenario states of it.
void withdraw(Effects<double>& effects, const Effects<double>& stated, const Candidate& candidate);

/// Every fault that a recording may have itself.
std::vector<Candidate> fault_candidates(const Magnitudes& sizes, bool has_torque_spikes);

/// Why no diagnosis predicts a drive with these effects; empty if one does.
std::string why_not_diagnosed(const Effects<double>& stated);

/// Whether a drive with these effects is followed with their states, and with an inertia of every angle; its teeth are
/// rigid then.
inline bool is_followed_with_states(const Effects<double>& effects) {
  return effects.have_states() || effects.inertia_varies();
}

/// Effects of the catalogue that are no candidates in a drive of this kind that has these effects, with the reason.
struct NotExamined {
  std::string_view effect;
  std::string_view reason;
  bool needs_worm_encoder = false;  ///< another recording could show it
};
std::vector<NotExamined> not_examined(const Effects<double>& stated, const Magnitudes& sizes);

/// Whether an effect moves worm and gear against each other. What two encoders show of that no torque can explain.
bool is_kinematic(std::string_view effect);
/// Whether an effect lets teeth meet across a gap.
bool has_impacts(std::string_view effect);

}  // namespace wormdrive
