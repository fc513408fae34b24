#pragma once
#include <cmath>
#include <cstdint>

namespace wormdrive::test::near_ties {

/// Random numbers that are the same everywhere, of a stream that a seed and an index name (SplitMix64).
class Dice {
 public:
  Dice(std::uint64_t seed, std::uint64_t index)
      : state_(seed * 0x9e3779b97f4a7c15u ^ (index + 1) * 0xd1342543de82ef95u) {
    next();
    next();
  }

  double between(double low, double high) { return low + (high - low) * uniform(); }
  /// Every decade is as likely.
  double decades(double low, double high) { return low * std::pow(high / low, uniform()); }
  int below(int count) { return static_cast<int>(uniform() * count); }
  bool chance(double share) { return uniform() < share; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }

 private:
  std::uint64_t next() {
    std::uint64_t x = state_ += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
  }
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }

  std::uint64_t state_;
};

}  // namespace wormdrive::test::near_ties
