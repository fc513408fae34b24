#pragma once
#include <vector>

namespace bench {

/// One output row, in SI; motion +1 forward, -1 backward, 0 stuck; flank +1 left, -1 right, 0 while stuck.
struct Row {
  double t, theta_g, omega_g, alpha_g, tau_m, tau_l, normal_force;
  int motion, flank;
};

/// A run from beginning to end; every event stands in it twice, just before and just after.
struct Run {
  std::vector<Row> rows;
  long steps = 0, evaluations = 0;
};

/// What both programs are given.
struct Settings {
  bool bdf;  ///< BDF with Newton and the exact Jacobian, otherwise Adams with fixed point
  double relative_tolerance, absolute_tolerance;
};

inline constexpr double end_time = 2.0;  ///< [s]
inline constexpr int outputs = 1000;     ///< equally spaced, besides the events
inline constexpr double output_interval = end_time / outputs;

/// Fig. 9 by plain calls of CVODE, without anything of wormdrive.
Run by_hand(const Settings& settings);

}  // namespace bench
