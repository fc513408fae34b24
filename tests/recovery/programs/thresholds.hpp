#pragma once
#include <string>
#include <vector>

#include "recovery/campaign.hpp"

namespace recovery {

/// Down to which size a diagnosis gives a good answer on most benches, against what the certificates say.
struct Limit {
  double certified;      ///< largest of the same benches with nothing hidden; infinity: not at all on one
  double reached = 0.0;  ///< smallest multiple of each one's down to which most answers are good; 0: none
  double missed = 0.0;   ///< the next smaller multiple, whose answers were not; 0: all were good
  std::string answer{};  ///< the last that was not good
};

/// From which size on an effect is seen at all, and from which it is named.
struct Threshold {
  const truth::Secret* secret;
  Limit seen, named;
};

/// Multiples of a certified size that are hidden, largest first.
inline constexpr double multiples[] = {2.0, 1.0, 0.5, 0.25};

/// What is drawn of each: noise decides on sizes near a threshold.
inline constexpr long benches = 3;

/// Measures the thresholds of the effects of a plan, ideal conditions, until the first that is missed.
std::vector<Threshold> thresholds(const Plan& plan, const Diagnose& diagnose);

/// An effect that a motion cannot show, hidden in it all the same.
struct Unseen {
  const truth::Secret* secret;
  std::string motion;
  bool certified = false;  ///< the certificate calls it unobservable, or visible from a larger size on only
  bool silent = false;     ///< nothing was named
  std::string answer{};
};
std::vector<Unseen> unseen(std::uint64_t seed, const Diagnose& diagnose);

/// Tables in Markdown.
std::string table(const std::vector<Threshold>& measured);
std::string table(const std::vector<Unseen>& cases);

}  // namespace recovery
