#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "statistics/column.hpp"

namespace wormdrive {

/// A column that hands its values over from memory from the second time on, unless they are more than `most`.
class HeldColumn {
 public:
  explicit HeldColumn(Column column) : column_(std::move(column)) {}

  void operator()(const TakeValues& take) const {
    if (whole_) return take(values_);
    bool fits = true;
    values_.clear();
    column_([&](std::span<const double> part) {
      take(part);
      fits = fits && values_.size() + part.size() <= most;
      if (fits) values_.insert(values_.end(), part.begin(), part.end());
    });
    if (fits)
      whole_ = true;
    else
      values_ = {};
  }
  /// All values, where they have been handed over and are held.
  std::optional<std::span<const double>> whole() const {
    return whole_ ? std::optional<std::span<const double>>(values_) : std::nullopt;
  }

 private:
  static constexpr std::size_t most = std::size_t{1} << 24U;  ///< 128 MB

  Column column_;
  mutable std::vector<double> values_;
  mutable bool whole_ = false;
};

}  // namespace wormdrive
