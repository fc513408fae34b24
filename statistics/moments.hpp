#pragma once
#include <cmath>
#include <span>

namespace wormdrive {

/// Mean and deviation of finite values that come one after the other or part by part, joined as [Chan1983] does.
struct Moments {
  double count = 0.0, mean = 0.0;
  double squares = 0.0;  ///< of the distances from the mean

  void add(std::span<const double> values) {
    if (values.empty()) return;
    const auto added = static_cast<double>(values.size());
    double sum = 0.0;
    for (const double value : values) sum += value;
    const double mean_of_added = sum / added, distance = mean_of_added - mean, before = count;
    count += added;
    mean += distance * (added / count);
    squares += distance * distance * before * (added / count);
    for (const double value : values) squares += (value - mean_of_added) * (value - mean_of_added);
  }
  void add(double value) { add({&value, 1}); }

  /// Of a sample of more than one value.
  double deviation() const { return std::sqrt(squares / (count - 1.0)); }
};

}  // namespace wormdrive
