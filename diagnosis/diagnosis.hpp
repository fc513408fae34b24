#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/unit.hpp"
#include "description/scenario.hpp"

namespace wormdrive {

/// What a diagnosis comes to.
enum class Verdict {
  adequate,    ///< nothing that these data show is missing
  named,       ///< the cause, or several, are known
  ambiguous,   ///< one of a class of causes that these data cannot tell apart
  unexplained  ///< something is missing that no effect of the catalogue accounts for; no name is claimed
};

/// A parameter of an effect as the data have it, in SI.
struct Estimate {
  std::string field;  ///< name of the effect's field, "drop"
  Unit unit;          ///< at the edge of the program
  double value{}, standard_error{};
  double low{}, high{};  ///< 95 % interval
};

/// An effect with its parameters.
struct EstimatedEffect {
  std::string effect;  ///< id in the catalogue, or of a fault of the recording
  std::vector<Estimate> parameters;
  std::string remedy{};  ///< of such a fault: what to change in the file, a sentence; empty of an effect
};

/// What data leave open of several numbers together: a normal distribution, and draws where they are asked for.
struct JointEstimate {
  std::vector<std::string> effects;  ///< of each number
  std::vector<Estimate> numbers;
  std::vector<std::vector<double>> correlation;
  std::vector<std::vector<double>> draws{};  ///< of all numbers
};

/// One effect, or class of effects, that was tried, and what came of it.
struct RankedCandidate {
  EstimatedEffect effect;
  double delta_bic{};      ///< BIC of the model without it less that with it
  double held_out_gain{};  ///< log likelihood of data not used for the fit, with it less without it [nats]
  bool named = false;
  std::string outcome;  ///< "named", or why not, a phrase
};

/// Error of predicting the gear angle ahead, or torques, on data not used for the fit, rms.
struct PredictionError {
  double horizon{};  ///< [s]
  double before{}, after{};
  double after_low{}, after_high{};  ///< 95 % interval by a bootstrap of blocks
  double floor{};                    ///< what the noise of the data alone comes to
  double constant_speed{};           ///< of going on at the speed of the start; NaN of torques
  Unit unit = unit::radian;          ///< N m where the data are torques, which have no horizon: it is NaN
};

/// What these data can show of an effect.
struct Visibility {
  std::string effect;
  std::string field;   ///< whose size is told
  std::string chosen;  ///< for which choice, "periods = 8"; empty where there is one only
  Unit unit;
  double detectable{};  ///< smallest size that can be seen, in SI; infinity: none
  double nameable{};    ///< smallest size that can be told apart from other effects, of exact twins as their class;
                        ///< infinity: none
  double resolved{};    ///< the same by the data alone, whatever is stated of it
  std::string nearest;  ///< that effect
  double likeness{};    ///< share of its signature that the nearest effect can imitate, 0 to 1
  bool observable = true;
};

/// Structure left in the residual torque over one axis.
struct Remainder {
  std::string axis;    ///< "speed", "angle and direction", "load", "time", "worm phase", ...
  double evidence{};   ///< standard deviations above what noise gives
  double torque{};     ///< rms of it [N m]
  double gain{};       ///< log likelihood that it would add [nats]
  double frequency{};  ///< of a line that any flank has [Hz]; 0 of all else
};

/// One sample of the residual torque, before and after; columns of the maps.
struct ResidualTorque {
  std::vector<double> time, gear_angle, gear_speed, load_torque, worm_phase;  ///< [s, rad, rad/s, N m, rad]
  std::vector<double> before, after;                                          ///< [N m]
  std::vector<std::uint8_t> held_out;
};

/// A stretch of data not used for the fit, predicted over one horizon by the model before and after.
struct PredictionExample {
  double horizon{};                                   ///< [s]
  std::vector<double> time, measured, before, after;  ///< [s, rad]
};

/// Torques at constant speed or at break-in, as measured and as predicted; columns.
struct PredictedTorques {
  std::vector<std::string> names;
  std::vector<double> worm_speed, load_torque;  ///< [rad/s, N m]; the speed is 0 at break-in
  std::vector<double> measured, before, after;  ///< [N m]; each point by the fit that did not see it
};

/// A number of the drive by earlier and by later data, in SI.
struct Change {
  std::string effect;
  Estimate before;      ///< its error is infinite where the earlier data show the effect at no size
  Estimate after;       ///< the same field by the later data
  Estimate difference;  ///< after less before, with the errors of both
  bool certain = false;
};

/// What later data are compared with.
struct Since {
  std::vector<std::string> files;
  Verdict verdict = Verdict::adequate;  ///< on the earlier data
  std::string sentence;                 ///< the same
  Scenario scenario;                    ///< fitted to them
  std::vector<Change> changes;          ///< those that are certain first
};

/// What a diagnosis found; plain data, all in SI.
struct Diagnosis {
  Verdict verdict = Verdict::adequate;
  std::string sentence;  ///< for people: what is wrong, by how much, what is gained
  std::vector<EstimatedEffect> causes;
  /// Ids of effects that these data cannot tell apart, those in `causes` first; which of them are at work is not known.
  std::vector<std::vector<std::string>> classes;
  std::vector<RankedCandidate> ranking;      ///< best first
  std::vector<EstimatedEffect> calibration;  ///< stated parameters that moved, within tolerance or as part of a cause
  std::vector<PredictionError> prediction;
  std::vector<Visibility> certificate;
  std::vector<Remainder> remainders;   ///< what is left, strongest first; empty: nothing above the noise
  Scenario extended;                   ///< the scenario with the causes, ready to simulate
  JointEstimate uncertainty;           ///< of all numbers that were fitted to the data
  std::optional<Scenario> experiment;  ///< one that would split the class
  std::string experiment_reason;       ///< a sentence
  ResidualTorque residual;
  std::vector<PredictionExample> examples;
  PredictedTorques torques;          ///< of records at constant speed and of break-in tables
  std::vector<Estimate> identified;  ///< constants that the data state directly: C1, C2, mu_s of a break-in table
  std::optional<Since> since;        ///< of a comparison with earlier data
  std::vector<std::string> remarks;  ///< on the data and on the diagnosis
  double noise_torque{};             ///< of the process, rms [N m]
  double noise_angle{};              ///< of the sensor, rms [rad]
  std::uint64_t seed{};
  long passes{};  ///< predictions of a whole recording
};

}  // namespace wormdrive
