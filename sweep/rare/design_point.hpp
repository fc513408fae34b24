#pragma once
#include <cstdint>

#include "sweep/rare/limit_state.hpp"

namespace wormdrive {

/// The most likely point at which the limit is missed, in standard normal space.
struct DesignPoint {
  NormalPoint point;
  double beta = 0.0;      ///< its distance from the median drive; FORM's probability is Phi(-beta)
  NormalPoint direction;  ///< cosines of the way to it; the square of one is the importance of its parameter
  bool converged = false;
  std::uint64_t evaluations = 0;
};

/// How often the search evaluates the limit state at most.
std::uint64_t most_evaluations_for_design_point(std::size_t dimensions);

/// Searches the design point by the improved method of Hasofer, Lind, Rackwitz and Fiessler with a merit function
/// [ZhangDerKiureghian1995]; gradients by central differences. All points have the noise of one index. The median
/// drive must keep the limit.
DesignPoint find_design_point(const LimitState& limit_state, std::size_t dimensions, std::uint64_t noise);

}  // namespace wormdrive
