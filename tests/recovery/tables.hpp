#pragma once
#include <string>
#include <vector>

#include "recovery/campaign.hpp"

namespace recovery {

/// How many of the outcomes have a score.
long count(const std::vector<Outcome>& outcomes, Score score);

/// The smallest number of successes in n trials that a success rate p does not fall short of but once in 1 / tail.
long least_successes(long n, double p, double tail = 1e-3);

/// Upper limit of the rate behind k successes in n trials, at 95 % confidence.
double rate_at_most(long k, long n);

/// Tables in Markdown: scores by size, what was named for what was hidden, errors of the parameters, time.
std::string tables(const Plan& plan, const std::vector<Outcome>& outcomes);

/// What was named, or in a word why nothing was.
std::string answer(const Outcome& outcome);

/// One line per outcome: what was hidden, what was named.
std::string line(const Outcome& outcome);

}  // namespace recovery
