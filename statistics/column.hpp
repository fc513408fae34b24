#pragma once
#include <functional>
#include <span>

namespace wormdrive {

/// Takes values, one part of them after the other.
using TakeValues = std::function<void(std::span<const double>)>;

/// Values that may be too many to be held at once: hands them over in order, part by part, as often as it is called.
using Column = std::function<void(const TakeValues&)>;

/// Two columns of equal length, hand in hand.
using TakePairs = std::function<void(std::span<const double>, std::span<const double>)>;
using PairColumn = std::function<void(const TakePairs&)>;

}  // namespace wormdrive
