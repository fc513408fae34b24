#pragma once
#include <vector>

#include "diagnosis/candidates/magnitudes.hpp"
#include "diagnosis/diagnosis.hpp"
#include "diagnosis/fitting/hypothesis.hpp"

namespace wormdrive {

/// Looks for structure that a hypothesis leaves in the residuals: a torque that is a free function of speed, of angle
/// and direction, of time, of load, each by a score test with the free coordinates projected out; and single lines in
/// the spectrum. What is found, strongest first; empty if the hypothesis is adequate. all: where lines are sought, for
/// they are sharp where time is long; pieces: of all, where torques are. Nothing is held out of either.
std::vector<Remainder> remainders(const Evaluation& all, const Hypothesis& h, const Evaluation& pieces,
                                  const Magnitudes& sizes);

/// The same in the order of their evidence.
std::vector<Remainder> strongest_first(std::vector<Remainder> all);

/// What was tested, whether anything was found or not.
struct ScoreTest {
  Remainder what;
  double held_out{};  ///< gain of data that the torque was not fitted to [nats]
  double ahead{};     ///< square of the error ahead that a line makes, over that which all else makes
  bool found = false;
  std::vector<double>
      torque{};  ///< at every sample, fitted to what is not held out [N m], if kept; of a line or a place none
};
/// Of torques over axes.
std::vector<ScoreTest> score_tests(const Evaluation& evaluation, const Hypothesis& h, const Magnitudes& sizes,
                                   bool keep_torques = false);

/// Share of the error ahead that goes once the torque of each remainder is added, 0 where that may be chance, or where
/// a line is no vibration that can be learned; of other lines and of places, and where nothing can be predicted,
/// infinity. evaluation: with data that are held out.
std::vector<double> shares_of_error(const Evaluation& evaluation, const Hypothesis& h, const Magnitudes& sizes,
                                    const std::vector<Remainder>& remainders);

}  // namespace wormdrive
