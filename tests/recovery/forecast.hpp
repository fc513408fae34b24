#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "recovery/campaign.hpp"

namespace recovery {

/// A metric of a task: what the data of a diagnosis leave possible, and what the true drive does. In SI.
struct Forecast {
  std::string metric;
  double low{}, high{};  ///< 95 % of the possible drives lie between
  double truth{};

  bool holds() const { return low <= truth && truth <= high; }
};

/// Gives a drive a task that its recording does not contain, under a controller that believes the data sheet: so many
/// drives drawn from the joint distribution that the data leave, and the true drive, with the numbers of the ground
/// truth. Empty where the diagnosis fitted no number.
std::vector<Forecast> forecast(const Case& drawn, const truth::Drive& drive, const wormdrive::Diagnosis& found,
                               std::uint64_t trials);

/// Effects whose numbers the ground truth tells completely, so that its drive can be simulated here.
std::vector<std::string> told_effects();

}  // namespace recovery
