#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <tuple>

#include "control/reference_point.hpp"
#include "core/field.hpp"
#include "statistics/random.hpp"

namespace wormdrive {

/// A new angle at every interval, uniform within the amplitude; the same seed gives the same steps.
struct RandomStepsReference {
  static constexpr std::string_view kind = "random_steps";
  static constexpr std::string_view meaning = "a new random angle at every interval";
  double amplitude{};
  double interval{};
  double seed{1};

  static constexpr auto fields() {
    using P = RandomStepsReference;
    return std::tuple{Field{&P::amplitude, "amplitude", unit::radian, bounds::any, "largest angle, either sign"},
                      Field{&P::interval, "interval", unit::second, bounds::positive, "time between two steps"},
                      Field{&P::seed, "seed", unit::whole, seeds, "seed of the random angles", Presence::optional}};
  }
  bool operator==(const RandomStepsReference&) const = default;
  ReferencePoint at(double t) const {
    const auto k = static_cast<std::uint64_t>(std::max(0.0, std::floor(t / interval)));
    return {amplitude * (2.0 * uniform(static_cast<std::uint64_t>(seed), Stream::reference, k) - 1.0), 0.0, 0.0};
  }
};

}  // namespace wormdrive
