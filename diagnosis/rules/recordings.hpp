#pragma once
#include <cstddef>

/// The numbers that decide what a diagnosis says, once each, with unit, origin and reason:
///   derived   follows from mathematics, from physics or from another rule
///   standard  a convention of statistics
///   set       chosen where recordings of known truth (docs/diagnosis_benchmark.md) and the measured drives do best
/// Where a search starts, and in which steps it goes, stands with the search: it costs time, not names.
/// These are of what a recording has to be.
namespace wormdrive::rules {

// Recordings: what can be diagnosed.

/// samples | set | fewer leave no third of the blocks that tells noise from structure
inline constexpr std::size_t least_samples = 1000;
/// s | set | slower samples do not show how a drive starts and stops
inline constexpr double longest_period = 0.02;
/// s | derived | six blocks, two of them held out
inline constexpr double least_duration = 3.0;
/// rows | set | fewer at constant speed show no law of friction
inline constexpr std::size_t least_rows = 8;
/// steps of the encoder | set | a smaller motion is rounding
inline constexpr double least_motion = 20.0;
/// share of a step | derived | a stamp that misses an even grid by less moves an angle by less than noise does
inline constexpr double even_enough = 0.02;
/// share of a step | derived | further off, a stamp does not tell which time of an even grid it stands for
inline constexpr double latest_stamp = 0.25;
/// samples on either side | set | a drift bends their line by nothing, one late stamp by itself
inline constexpr std::size_t neighbours_of_stamp = 50;
/// share of a step | derived | of stamps at random, half lie so near a whole number of steps
inline constexpr double near_whole_step = 0.25;
/// share of the steps | derived | midway between stamps at random and those of a clock
inline constexpr double least_whole_steps = 0.75;

// Recordings: samples that no measurement can have given.

/// robust deviations | set | noise, however it is distributed, does not come so far
inline constexpr double impossible_deviations = 20.0;
/// usual peaks | set | a drive that rests most of the time has torques far from the median, none of a size all its own
inline constexpr double impossible_peaks = 5.0;
/// samples | set | more neighbours in a row are no outlier but a jump
inline constexpr std::size_t longest_impossible = 5;
/// share of the samples | set | with more of them the recording as a whole is not to be trusted
inline constexpr double most_impossible = 0.01;
/// samples | set | a path is judged from a stretch as long as this without an outlier
inline constexpr std::size_t undisturbed_samples = 8;
/// readings | set | so many equal ones in a row are a standstill
inline constexpr std::size_t standing_readings = 10;
/// samples | set | the speed just beside a standstill is taken over these
inline constexpr std::size_t beside_standstill = 5;
/// times what the drive can do | set | a start that is faster is the encoder's
inline constexpr double impossible_start = 1.5;
/// share of a tooth of a worm with one start | set | no gap is wider: the worm that crosses it gives the gear a speed
inline constexpr double widest_gap = 0.08;
/// steps of the encoder | derived | two readings at either end of a speed, each wrong by one
inline constexpr double rounding_of_speed = 4.0;
/// turns | set | a jump so near a whole number of turns is an angle counted within one
inline constexpr double near_whole_turn = 0.05;
/// samples on either side | derived | a median of seven samples is not moved by three
inline constexpr std::size_t spike_reach = 3;
/// of the torque's deviation | set | a smaller spike moves the drive little
inline constexpr double least_spike = 0.5;
/// samples | set | more spikes than one in so many are the torque itself
inline constexpr std::size_t rarest_spike = 100;

// Recordings: the steps of an encoder, as its readings show them.

/// differences | set | of fewer distinct readings none tells a step
inline constexpr std::size_t fewest_differences = 10;
/// steps | set | of larger differences the rounding of the file hides whether they are whole
inline constexpr double largest_telling_difference = 5.5;
/// share of a step | set | a difference so near a whole number of steps is one
inline constexpr double near_whole_reading = 0.05;
/// share of the differences | set | so many are whole where there are steps
inline constexpr double least_whole_readings = 0.9;
/// share of the readings | set | more that repeat the one before are too close together to be news
inline constexpr double most_repeated = 0.25;

// Recordings: columns that are not what they are called.

/// share of the torque | set | with more unaccounted for, the columns are in doubt
inline constexpr double too_much_unaccounted = 0.6;
/// share of the torque | set | another reading accounts for the torque if it leaves less than this
inline constexpr double well_accounted = 0.35;
/// share | set | ... and less than this of what the columns as they stand leave
inline constexpr double clearly_less = 0.5;
/// share | set | a load is missing if a mass on an arm leaves less than this of what no load leaves; of drives without
/// one, whatever else they lack, it leaves 0.96 or more
inline constexpr double less_with_load = 0.9;
/// square of a correlation | set | a recorded speed that follows the angle's derivative less is not it
inline constexpr double least_speed_likeness = 0.8;
/// times the derivative | set | a recorded speed between its inverse and this is the derivative
inline constexpr double most_speed_factor = 1.25;
/// share | set | a factor so near that of a unit is the unit
inline constexpr double near_unit = 0.05;
/// square of a correlation | set | a worm and a gear whose teeth mesh go together so closely
inline constexpr double least_meshing = 0.99;
/// share | set | no encoder's scale is off by so much: the ratio is another one
inline constexpr double other_ratio = 0.1;
/// share | set | a ratio so near that of a slip is the slip
inline constexpr double near_ratio = 0.02;
/// times what is needed | set | a torque further off is of another unit, or of another drive
inline constexpr double wrong_size = 10.0;
/// times the median speed | set | where it is slower, friction at rest hides the torque
inline constexpr double too_slow_for_torque = 0.3;
/// samples | set | fewer that tell anything tell nothing
inline constexpr std::size_t fewest_for_torque = 100;

// Recordings: how they are cut.

/// s | set | dropped from the start, for the initial speed is a guess
inline constexpr double burn_in = 0.1;
/// s | set | data are held out and compared by blocks as long as this
inline constexpr double block = 0.5;
/// blocks | standard | one in three is held out
inline constexpr std::size_t held_out_every = 3;
/// samples | set | the search for causes takes so many, five times what the recordings of the benchmark have; more are
/// for the fit of what it has found
inline constexpr std::size_t most_searched = 120'000;
/// s | set | pieces of long recordings have twenty blocks each
inline constexpr double piece = 10.0;
/// s | set | the speed is the slope of a line over as much on either side
inline constexpr double slope_half_width = 0.012;
/// samples | derived | a slope over fewer is the noise of its readings
inline constexpr long least_half_width = 4;
/// share of the rms speed | set | what is slower stands
inline constexpr double standing_share = 0.008;

}  // namespace wormdrive::rules
