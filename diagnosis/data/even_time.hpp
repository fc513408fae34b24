#pragma once
#include <string>
#include <vector>

#include "diagnosis/data/recorded_table.hpp"

namespace wormdrive {

/// The sample times of a recording: even, or drifting so slowly that every stretch of it is.
struct EvenTime {
  double start, period;       ///< of the first sample, and between two samples on average [s]
  std::vector<double> times;  ///< of every sample since the first, where they drift off an even grid [s]; else empty
  std::vector<std::string> remarks;
};

inline constexpr double longest_period = 0.02;  ///< [s]: slower samples do not show how a drive starts and stops
inline constexpr double even_share = 0.1;  ///< of a step by which a time may miss the even grid of its neighbours, and
                                           ///< a steady step the average one
inline constexpr double even_enough = 0.02;  ///< of a step: what misses one even grid by less is taken for even

/// The times at which a recording was sampled, freed from their jitter. Throws InputFault, with the line, for too few
/// samples, a time that is negative, repeated, decreasing or leaves a gap, for a step that differs from its
/// neighbours', and for a drift that makes another rate of it.
EvenTime even_time(const RecordedTable& table);

}  // namespace wormdrive
