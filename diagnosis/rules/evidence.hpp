#pragma once
#include <cstddef>

/// When a candidate is believed; the form is that of recordings.hpp.
namespace wormdrive::rules {

// Evidence for a candidate.

/// BIC | standard | very strong twice over [Kass and Raftery 1995]: of a candidate of which nothing is stated
inline constexpr double least_bic = 20.0;
/// nats | standard | odds of twenty to one on data that were held out
inline constexpr double least_held_out = 3.0;
/// medians | set | where a block's gain is cut, so that no single one decides
inline constexpr double clip = 4.0;
/// share of the blocks' ranks | set | so many have to gain where the gain counts clipped only: what says little, and
/// one that says much, does not outvote the others
inline constexpr double positive_share = 0.7;
/// BIC | standard | strong, of a stated parameter that is off: its tolerance has taken a part
inline constexpr double least_bic_toleranced = 5.0;
/// standard deviations | standard | one false name in two thousand numbers that are stated rightly
inline constexpr double least_tolerances = 3.5;
/// share of the BIC's gain | derived | is most of it
inline constexpr double mostly = 0.5;
/// share of the error ahead | derived | is most of it: what takes that away is borne out, whatever single blocks cost
inline constexpr double most_of_error = 0.5;
/// share of the BIC's gain | set | that held-out data may lose by a stated parameter: it was free before
inline constexpr double held_out_loss = 0.05;
/// share of the best evidence | set | candidates so near the best one form a class with it
inline constexpr double equivalence_share = 0.03;
/// BIC | standard | the same for weak evidence: very strong [Kass and Raftery 1995]
inline constexpr double equivalence_bic = 10.0;
/// coefficient of friction | set | teeth rub no more: dry steel slides on steel at 0.57 [Bowden and Tabor 1950]
inline constexpr double highest_friction = 0.6;
/// times the smallest speed | set | a fall of friction over less is friction at rest
inline constexpr double fall_like_rest = 2.0;
/// BIC | standard | among candidates that differ by less, the one with the fewest parameters comes first
inline constexpr double as_good = 6.0;
/// share of the error ahead | set | a further cause lowers it by more
inline constexpr double least_improvement = 0.01;
/// times the best within bounds | set | what outdoes it by more, at a bound, leaves no room for a smaller name
inline constexpr double far_beyond = 2.0;
/// share of the gain | set | a pair, or another set of causes, has to gain more than this to be clearly better
inline constexpr double clear_share = 0.05;
/// share of the least tolerances | set | a number so far off is tried free of its tolerance, which draws it back
inline constexpr double suspicious = 0.7;
/// share of the error ahead | set | a search without a noise model is kept if it leaves less than this
inline constexpr double clearly_better = 0.9;
/// BIC | derived | what an unknown costs in a linear promise: about ln N
inline constexpr double price_of_unknown = 10.0;
/// share | set | of the curvature that a block may owe to its own part in the fit
inline constexpr double most_own_curvature = 0.9;

// Search: what is tried at all.

/// share of its price | set | a candidate that promises less is not followed
inline constexpr double least_promise = 0.5;
/// candidates, starts | set | fitted in a round at most
inline constexpr std::size_t most_fitted = 6, most_starts = 12;
/// share of a sample | set | a torque that is late by less is not: to bring it forward mixes in a trace of the next
/// one, which answers the very reading that is predicted, and so foretells that reading's noise
inline constexpr double least_late = 0.1;
/// values | set | of a drift of clocks, fast and slow ones each, that are tried out as they are
inline constexpr int most_far_clocks = 16;
/// share of the first start's gain, of the best gain | set | a second start of a candidate needs both
inline constexpr double second_start = 0.5, second_start_of_best = 0.3;
/// share of the best gain | set | a candidate beyond most_fitted needs this
inline constexpr double late_candidate = 0.4;
/// candidates | set | the best ones, whose noise and law are sought anew
inline constexpr std::size_t most_refined = 3;
/// candidates, BIC | set | taken over from a search without a noise model, and what each has to promise
inline constexpr std::size_t most_from_other = 3;
inline constexpr double least_from_other = 10.0;
/// pairs | set | of causes that may hide each other, fitted together
inline constexpr std::size_t most_pairs = 6;
/// turns | set | of noise and model, each of which hides what the other one lacks
inline constexpr int most_turns = 5, turns_alone = 2;
/// factor | set | between the sizes of a gap that are tried out: a maximum was a quarter wide
inline constexpr double gap_step = 1.2;
/// share of the widest gap | set | narrower ones are found by the slopes of the narrowest start
inline constexpr double least_gap = 0.008;
/// restitution | set | with it the likelihood was smoothest over the size of a gap
inline constexpr double smooth_restitution = 0.4;
/// nats | set | another process noise, another gap and another round of a fit have to gain more
inline constexpr double least_noise_gain = 0.05, least_gap_gain = 2.0, least_round_gain = 0.3;
/// nats | derived | a draw stops where a step promises less: a twentieth of its standard deviation
inline constexpr double least_draw_gain = 1e-3;
/// steps | set | of the fit of a draw; three are usual
inline constexpr int most_draw_rounds = 10;
/// share of what makes a round worth another one | derived | a step that promises less is the end of a fit
inline constexpr double nothing_to_gain = 0.03;

}  // namespace wormdrive::rules
