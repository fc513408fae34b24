#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "diagnosis/learned/map_forms.hpp"

namespace wormdrive {

/// A map that is learned from what a hypothesis leaves unexplained.
struct LearnedMap {
  MapForm form;
  std::vector<double> points, values{};  ///< of its table
  double smoothness{};                   ///< that the data asked for
  double left_out{};  ///< how much worse it predicts what was left out than no map does [nats]; negative
};

/// Switches the effect of a map on, with its table.
void put_on(RecordedDrive& drive, const LearnedMap& map);

/// A map of nothing yet, with that number of points and the smoothness that predict best what is left out; nothing
/// where no map does. sorted: the values of its axis. counts: numbers of points to try, fewest first.
std::optional<LearnedMap> chosen_by_parts(const Evaluation& evaluation, const Hypothesis& h, const MapForm& form,
                                          const std::vector<double>& sorted, std::span<const std::size_t> counts);

/// Adds a map to a hypothesis and fits its values and, by turns, the noise and the stated parameters beside it.
void fit_map(const Evaluation& evaluation, Hypothesis& h, LearnedMap& map);

}  // namespace wormdrive
