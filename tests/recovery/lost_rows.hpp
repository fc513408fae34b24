#pragma once
#include <algorithm>
#include <cstddef>
#include <random>
#include <vector>

#include "recovery/truth/recording.hpp"

namespace recovery {

/// Which of so many rows a logger lost: a share of them, in runs, neither the first nor the last.
inline std::vector<char> lost_rows(std::size_t rows, double share, std::size_t run, std::mt19937_64& random) {
  std::bernoulli_distribution begins(std::min(1.0, share / static_cast<double>(run)));
  std::vector<char> lost(rows, 0);
  std::size_t left = 0;
  for (std::size_t k = 1; k + 1 < rows; ++k) {
    if (left == 0 && begins(random)) left = run;
    if (left > 0) {
      lost[k] = 1;
      --left;
    }
  }
  return lost;
}

/// Takes the rows out that are lost.
template <class T>
void lose(std::vector<T>& column, const std::vector<char>& lost) {
  std::size_t k = 0;
  std::erase_if(column, [&](const T&) { return lost[k++] != 0; });
}

/// Takes the rows out of what a logger writes.
inline void lose(truth::Recording& recorded, const std::vector<char>& lost) {
  for (std::vector<double>* column : {&recorded.time, &recorded.motor_torque, &recorded.gear_angle})
    lose(*column, lost);
  if (!recorded.worm_angle.empty()) lose(recorded.worm_angle, lost);
}

}  // namespace recovery
