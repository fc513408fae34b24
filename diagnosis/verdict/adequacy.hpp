#pragma once
#include <vector>

#include "diagnosis/candidates/magnitudes.hpp"
#include "diagnosis/diagnosis.hpp"
#include "diagnosis/fitting/hypothesis.hpp"

namespace wormdrive {

/// From when on something is left.
struct AdequacyRules {
  double most_deviations = 1.5;                ///< of a score above what noise gives
  double most_gain = 4.0;                      ///< of data that the torque was not fitted to [nats]
  double least_share = 5e-4;                   ///< of the rms torque; what is smaller is of no account
  double least_share_of_two_encoders = 0.005;  ///< where a worm's encoder leads: it rounds more than it is noisy
  double most_line = 8.0;             ///< of a spectral line: -log of the chance that noise makes one as strong
  double least_ahead = 0.1;           ///< of a line: its share of the error's square ahead, a twentieth of the error
  double most_place = 12.0;           ///< of one angle: the same; coloured noise makes eight
  double most_gain_of_a_place = 1.0;  ///< as most_gain; a place that is seldom passed need not be in those data
};

/// Looks for structure that a hypothesis leaves in the residuals: a torque that is a free function of speed, of angle
/// and direction, of time, of load, each by a score test with the free coordinates projected out; and single lines in
/// the spectrum. What is found, strongest first; empty if the hypothesis is adequate. by: nothing is held out.
std::vector<Remainder> remainders(const Evaluation& evaluation, const Hypothesis& h, const Magnitudes& sizes,
                                  const AdequacyRules& rules = {});

/// All that was tested, whether anything was found or not.
struct ScoreTest {
  Remainder what;
  double held_out{};  ///< gain of data that the torque was not fitted to [nats]
  double ahead{};     ///< square of the error ahead that a line makes, over that which all else makes
  bool found = false;
};
std::vector<ScoreTest> score_tests(const Evaluation& evaluation, const Hypothesis& h, const Magnitudes& sizes,
                                   const AdequacyRules& rules = {});

}  // namespace wormdrive
