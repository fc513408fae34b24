#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <string_view>
#include <tuple>
#include <vector>

#include "core/field.hpp"
#include "core/pieces/piece.hpp"

namespace wormdrive {

enum class Interpolation { hold, linear };

/// Measured or computed torques over strictly increasing times; the ends are held before and after.
struct Samples {
  static constexpr std::string_view kind = "samples";
  static constexpr std::string_view meaning = "samples of a CSV file, held or interpolated between their times";
  std::vector<double> times;   ///< [s]
  std::vector<double> values;  ///< [N m], as many as times
  Interpolation interpolation = Interpolation::hold;

  static constexpr auto choices() {
    return std::tuple{Choice{&Samples::interpolation, "interpolation",
                             std::array<std::string_view, 2>{"hold", "linear"}, "between the times"}};
  }
  void add_to(Piece& piece, double t) const {
    const std::size_t passed = samples_passed(t);
    if (passed == 0 || passed == times.size()) {
      piece.add(passed == 0 ? values.front() : values.back());
      return;
    }
    const std::size_t k = passed - 1;
    piece.add(values[k]);
    if (interpolation == Interpolation::hold) return;
    const double slope = (values[k + 1] - values[k]) / (times[k + 1] - times[k]);
    piece.add(slope * (t - times[k]));
    piece.slope += slope;
  }
  double next_knot(double t) const {
    const std::size_t passed = samples_passed(t);
    return passed < times.size() ? times[passed] : std::numeric_limits<double>::infinity();
  }

 private:
  std::size_t samples_passed(double t) const {
    return static_cast<std::size_t>(std::upper_bound(times.begin(), times.end(), t) - times.begin());
  }
};

}  // namespace wormdrive
