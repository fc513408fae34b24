#pragma once
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "statistics/column.hpp"

namespace wormdrive {

/// A column that hands its values over from memory from the second time on, unless they take more than 128 MB.
class HeldColumn {
 public:
  /// count: how many values it has.
  HeldColumn(Column column, std::uint64_t count) : column_(std::move(column)), fits_(count <= most) {
    if (fits_) values_.reserve(count);
  }

  void operator()(const TakeValues& take) {
    if (whole_) return take(values_);
    values_.clear();
    column_([&](std::span<const double> part) {
      take(part);
      if (fits_) values_.insert(values_.end(), part.begin(), part.end());
    });
    whole_ = fits_;
  }
  /// All values, where they have been handed over and are held.
  std::optional<std::span<const double>> whole() const {
    return whole_ ? std::optional<std::span<const double>>(values_) : std::nullopt;
  }

 private:
  static constexpr std::uint64_t most = std::uint64_t{1} << 24U;

  Column column_;
  std::vector<double> values_;
  bool fits_, whole_ = false;
};

}  // namespace wormdrive
