#pragma once
#include <bit>
#include <cstdint>

#include "sweep/study/random.hpp"

namespace wormdrive {

/// A random order of 0 ... size - 1 that needs no memory: any element is computed alone, on any machine.
///
/// A Feistel network permutes the next even power of two; what falls outside is sent through again until it falls
/// inside, which keeps it a permutation.
class KeyedPermutation {
 public:
  KeyedPermutation(std::uint64_t size, std::uint64_t seed, std::uint64_t key)
      : size_(size), seed_(seed), key_(key), half_((std::bit_width(size - 1) + 1) / 2) {}

  std::uint64_t operator()(std::uint64_t k) const {
    if (size_ == 1) return 0;
    do k = shuffled(k);
    while (k >= size_);
    return k;
  }

 private:
  std::uint64_t shuffled(std::uint64_t k) const {
    const std::uint64_t mask = (std::uint64_t{1} << half_) - 1;
    std::uint64_t left = k >> half_, right = k & mask;
    for (std::uint64_t round = 0; round < 6; ++round) {
      const std::uint64_t mixed = random_bits(seed_, SweepStream::permutation, right, (key_ << 8) | round)[0] & mask;
      const std::uint64_t next = left ^ mixed;
      left = right;
      right = next;
    }
    return (left << half_) | right;
  }

  std::uint64_t size_, seed_, key_;
  int half_;  ///< bits of either half
};

}  // namespace wormdrive
