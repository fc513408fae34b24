#pragma once
#include <array>
#include <cstddef>

/// How noise and errors of a prediction are counted; the form is that of recordings.hpp.
namespace wormdrive::rules {

// Noise.

/// degrees of freedom | standard | of Student's t, whose tails keep single samples from deciding [Lange et al. 1989]
inline constexpr double tail_freedom = 4.0;
/// share | set | by which weights may differ within half a step of an encoder: errors of rounding are skewed where the
/// gear moves by simple fractions of a step per sample, and unequal weights would make a bias of that
inline constexpr double unequal_within_step = 0.05;
/// s | set | time constants of the means that whiten innovations; the first is one sample
inline constexpr std::array<double, 6> whitening_times{0.0, 0.003, 0.008, 0.02, 0.05, 0.12};
/// s | set | time constant of a torque that lasts
inline constexpr double colouring_time = 0.05;
/// s | set | how far back a predictor remembers what was commanded
inline constexpr double remembered_time = 0.1;
/// samples | derived | of fewer, six weights are not known to a tenth
inline constexpr std::size_t fewest_for_weights = 300;
/// samples | derived | of fewer, a median is not known to a third
inline constexpr std::size_t fewest_for_scale = 20;
/// sum of the weights | derived | a mean that takes more of a steady innovation hides what is slow
inline constexpr double hides_what_is_slow = 0.5;
/// steps of the encoder | derived | standard deviation of rounding at rest: 1/sqrt(12)
inline constexpr double rounding_at_rest = 0.29;
/// steps of the encoder | set | while the gear moves, rounding is predicted in part
inline constexpr double rounding_moving = 0.1;
/// share of the squared scale of the noise | set | where errors of rounding are more, there is hardly any other noise
inline constexpr double mere_rounding = 0.8;
/// nats | derived | a process noise that makes the data less likely by less is in its 95 % confidence interval
inline constexpr double of_process_noise = 1.92;
/// scales of the noise | set | a process noise beyond these is none, or all there is
inline constexpr double least_process_noise = 1e-5, most_process_noise = 3.0;
/// scales of the noise | set | a process noise beyond this may stand for a motion that values far off would explain
inline constexpr double strong_process_noise = 0.3;
/// scales of the noise | derived | one that moved the angle within a sample by more would not let readings repeat
inline constexpr double most_process_noise_of_steps = 1.0;
/// rad | derived | so far off a prediction follows no motion, in steps that grow ever shorter
inline constexpr double lost = 1e3;
/// mode changes | derived | more within one sample are no mechanics
inline constexpr int most_events_of_a_sample = 60;
/// share | set | tolerance of a prediction by power series, whose differences have to show slopes
inline constexpr double predictor_tolerance = 1e-10;
/// s | set | a shorter bounce of the teeth is contact
inline constexpr double shortest_bounce = 5e-4;
/// scales of the noise | derived | a change beyond tells of another motion, not of a slope
inline constexpr double largest_change = 30.0;

// Prediction error.

/// s | set | the horizon that the sentence of a diagnosis states
inline constexpr double reported_horizon = 0.25;
/// s | set | how far ahead predictions are judged
inline constexpr double horizons[] = {0.1, reported_horizon, 1.0};
/// rad^2 | derived | a motion that was missed altogether counts no more than by a radian
inline constexpr double largest_square_error = 1.0;

}  // namespace wormdrive::rules
