#pragma once
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "statistics/column.hpp"

namespace wormdrive {

/// A column that hands its values over from memory from the second time on, unless they take more than 128 MB.
class HeldColumn {
 public:
  explicit HeldColumn(Column column) : column_(std::move(column)) {}

  void operator()(const TakeValues& take) {
    if (whole_) return take(values_);
    bool fits = true;
    values_.clear();
    column_([&](std::span<const double> part) {
      take(part);
      fits = fits && values_.size() + part.size() <= most;
      if (fits) values_.insert(values_.end(), part.begin(), part.end());
    });
    whole_ = fits;
    if (!fits) values_ = {};
  }
  /// All values, where they have been handed over and are held.
  std::optional<std::span<const double>> whole() const {
    return whole_ ? std::optional<std::span<const double>>(values_) : std::nullopt;
  }

 private:
  static constexpr std::size_t most = std::size_t{1} << 24U;

  Column column_;
  std::vector<double> values_;
  bool whole_ = false;
};

}  // namespace wormdrive
