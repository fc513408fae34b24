#pragma once
#include <string>
#include <vector>

#include "recovery/campaign.hpp"

namespace recovery {

/// From which size on an effect is named, against what a certificate says of the same bench with nothing hidden.
struct Threshold {
  const truth::Secret* secret;
  double detectable, nameable;  ///< of the certificate; infinity: not at all
  double named = 0.0;           ///< smallest multiple of `nameable` down to which all are named rightly; 0: none
  double missed = 0.0;          ///< the next smaller multiple, which was not; 0: all were named
  std::string answer{};         ///< to that one
};

/// Multiples of the nameable size that are hidden, largest first.
inline constexpr double multiples[] = {4.0, 2.0, 1.0, 0.5, 0.25};

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
