#pragma once
#include <cstring>

namespace wormdrive {

/// Two doubles in one register, for the work of one; each is rounded as a double alone.
using Pair = double __attribute__((vector_size(16)));

/// Two doubles that follow each other in memory.
inline Pair pair_at(const double* first) {
  Pair both;
  std::memcpy(&both, first, sizeof both);
  return both;
}

inline Pair abs(Pair x) {
  using Bits = long long __attribute__((vector_size(16)));
  return reinterpret_cast<Pair>(reinterpret_cast<Bits>(x) & 0x7fff'ffff'ffff'ffff);
}

}  // namespace wormdrive
