#pragma once
#include <cstddef>

#include "diagnosis/rules/evidence.hpp"

/// When an effect is believed of records at constant speed and of break-in tables, where that differs from recordings
/// over time; the form is that of recordings.hpp.
namespace wormdrive::rules::points {

/// points | set | fewer show no law
inline constexpr std::size_t fewest = 6;
/// BIC | standard | strong evidence [Kass and Raftery 1995], for an effect
inline constexpr double least_bic = 6.0;
/// BIC | derived | odds of ten to one: two models that differ by less are equally good
inline constexpr double equally_good = 4.6;
/// BIC | standard | hardly worth a mention [Kass and Raftery 1995]: of such models the one that predicts best
inline constexpr double equally_likely = 2.0;
/// share of a signature | set | the other named effects can imitate an effect from here on
inline constexpr double imitated = 0.95;
/// BIC for each cause | standard | as in a recording: what a model with more causes has to gain
inline constexpr double decisive_bic = rules::least_bic;
/// BIC | set | an effect that is exchanged for another has to gain more
inline constexpr double least_exchange = 0.5;
/// effects | set | at most, looked for at once, the same among those that nobody states
inline constexpr std::size_t most_causes = 6, together = 2, together_unstated = 5;
/// models | set | followed at each number of effects, and looked at closely of what glances promise
inline constexpr std::size_t most_models = 10, most_looked_at = 3;
/// scales | derived | a value so near a bound lies at it
inline constexpr double near_bound = 1e-4;
/// deviations | standard | one chance in seven hundred that neighbouring errors go together so
inline constexpr double left_evidence = 3.0;

}  // namespace wormdrive::rules::points
