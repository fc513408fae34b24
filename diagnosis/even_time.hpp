#pragma once
#include <string>
#include <vector>

#include "diagnosis/recorded_table.hpp"

namespace wormdrive {

/// An even grid of sample times.
struct EvenTime {
  double start, period;  ///< [s]
  std::vector<std::string> remarks;
};

inline constexpr std::size_t least_samples = 1000;  ///< of a recording
inline constexpr double least_duration = 3.0;       ///< [s]: six blocks of half a second, two of them held out
inline constexpr double longest_period = 0.02;      ///< [s]: slower samples do not show how a drive starts and stops
inline constexpr double even_share = 0.1;           ///< of a period by which a sample time may miss the even grid

/// The grid on which a recording was sampled. Throws InputFault, with the line, for too few samples, a time that is
/// negative, repeated, decreasing or leaves a gap, and for sample times that miss every even grid.
EvenTime even_time(const RecordedTable& table);

}  // namespace wormdrive
