#pragma once
#include <array>
#include <cstddef>

#include "diagnosis/rules/evidence.hpp"

/// What a verdict turns on; the form is that of recordings.hpp.
namespace wormdrive::rules {

// Adequacy: whether anything is left.

/// deviations | set | of a score above what noise gives
inline constexpr double left_deviations = 1.5;
/// nats | set | gain of data that a torque was not fitted to; of one place, which those data need not pass, less
inline constexpr double left_gain = 4.0, left_gain_of_a_place = 1.0;
/// share of the rms torque | set | what is smaller is of no account; with two encoders more, for the worm's rounds
inline constexpr double left_torque = 5e-4, left_torque_of_two_encoders = 0.005;
/// nats | set | -log of the chance that noise makes a line as strong
inline constexpr double left_line = 8.0;
/// share of the square of the error ahead | derived | of a line: a twentieth of the error
inline constexpr double left_ahead = 0.1;
/// nats | set | of one angle, as of a line; coloured noise makes eight
inline constexpr double left_place = 12.0;
/// scales of the noise | set | beyond which a residual counts no more: of a test torque, of a residual torque
inline constexpr double clip_of_test = 10.0, clip_of_torque = 6.0;
/// hat functions | set | over angle, speed, time or load, and spots of a tenth of a turn or less
inline constexpr int hats_over_angle = 8, hats_over_speed = 10, hats_over_time = 6, spots = 24;
/// precision | set | of a hat without data, which is nothing
inline constexpr double precision_of_hat = 0.3;
/// Hz | set | spectral lines between these: what is slower is a matter of angle and time
inline constexpr double lowest_line = 1.0, highest_line = 50.0;
/// lines on either side | set | that tell the level of noise
inline constexpr std::size_t lines_around = 25;
/// s | set | innovations are summed over this before their spectrum, residual torques averaged over that
inline constexpr double spectrum_bin = 0.005, torque_bin = 0.025;

// What is learned of what is left.

/// share of the rms torque | set | a torque whose effect is seen and small
inline constexpr double test_torque = 0.005;
/// points | set | of a map; the data choose among them
inline constexpr std::array<std::size_t, 4> points_of_map{5, 9, 17, 33};
/// points | set | of maps among which those are chosen that are fitted, and how many are
inline constexpr std::size_t points_of_trial_map = 9, maps_fitted = 3;
/// times what the data know | set | that the roughness of a map costs; the data choose among them
inline constexpr std::array<double, 6> smoothness_of_map{1e-3, 1e-2, 0.1, 1.0, 10.0, 100.0};

// Verdict.

/// share of the rms torque | set | noise of more is no noise: such a model does not know the motion
inline constexpr double most_noise = 1.0 / 3.0;
/// share of the error ahead at constant speed | set | a model that errs less knows the motion; with nothing hidden they
/// err by up to 0.1 of it, where the torque is not the drive's by more than 0.5
inline constexpr double most_of_motion = 0.15;
/// share of the error ahead | set | a smaller change or rest does not count; a stand-in for another effect leaves more
inline constexpr double of_no_account = 0.05;
/// times the error after | set | causes that lower it by more do most of the work
inline constexpr double most_of_the_error = 3.0;
/// times the noise floor | set | an error that is smaller is little but noise
inline constexpr double little_but_noise = 2.0;
/// times what is left | set | evidence of more is most of all; beside impacts, which are followed less well, of less
inline constexpr double most_of_the_evidence = 30.0, most_of_the_evidence_of_impacts = 10.0;
/// times the noise floor | set | a larger error ahead is structure that the tests took for outliers; beside impacts
inline constexpr double above_noise = 3.0, above_noise_of_impacts = 10.0;
/// squared deviations | derived | twice least_bic and ln N: length of a signature that a search finds
inline constexpr double findable_length = 60.0;
/// share | derived | evidence grows less than squared length, so a third of equivalence_share is left here
inline constexpr double nameable_share = equivalence_share / 3.0;
/// share | set | of a signature below which its shape, not its length, decides whether it can be named
inline constexpr double much_alike = 0.1;
/// ratio | derived | a wheel with one start is seldom stated wrongly by less than half a tooth
inline constexpr double least_other_ratio = 0.5;

// Experiments.

/// margin | set | an experiment that could name an effect so many times smaller is good enough
inline constexpr double ample_margin = 5.0;
/// motions | set | tried out with each payload: four numbers take a dozen to move at all
inline constexpr int most_motions = 30;
/// candidates | set | the best of those that might explain what nothing explains
inline constexpr std::size_t most_contenders = 4;
/// samples | set | of an experiment, which lasts as long as the longest recording where that is shorter
inline constexpr double most_of_experiment = 24000.0;
/// times what the recordings reached, or a slow sweep takes | set | that an experiment may ask where nothing is stated
inline constexpr double torque_beyond = 2.0, speed_beyond = 5.0;
/// rad | derived | a quarter of a turn and more: a load that turns with the gear pulls either way, and not at all
inline constexpr double either_way_of_load = 2.2;
/// share of half the way | set | kept free beside stops, and by which a motion may miss its range
inline constexpr double beside_stops = 0.1, beside_range = 0.02;
/// per sample | set | poles of the loop of an experiment, and its highest frequency: faster motions show how teeth
/// yield, of which a predictor with rigid teeth knows nothing
inline constexpr double pole_per_sample = 0.04, cycles_per_sample = 0.01;
/// share of the highest frequency | set | the lowest one of the fast sines
inline constexpr double lowest_sine = 0.15;

}  // namespace wormdrive::rules
