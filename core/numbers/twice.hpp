#pragma once
#include "core/numbers/lanes.hpp"

namespace wormdrive {

/// Twice as many lanes as a register has: while one half of them waits for a result, the other half is worked out.
template <class Width>
struct Twice {
  static constexpr int lanes = 2 * Width::lanes;
};

template <class Width>
struct LaneMask<Twice<Width>> {
  using Half = LaneMask<Width>;
  Half first, second;

  [[gnu::always_inline]] friend LaneMask operator&(const LaneMask& a, const LaneMask& b) {
    return {a.first & b.first, a.second & b.second};
  }
  [[gnu::always_inline]] friend LaneMask operator|(const LaneMask& a, const LaneMask& b) {
    return {a.first | b.first, a.second | b.second};
  }
  [[gnu::always_inline]] friend LaneMask operator!(const LaneMask& a) { return {!a.first, !a.second}; }
};

template <class Width>
struct Lanes<Twice<Width>> {
  using Half = Lanes<Width>;
  using Mask = LaneMask<Twice<Width>>;
  Half first, second;

  Lanes() = default;
  [[gnu::always_inline]] Lanes(double all) : first(all), second(all) {}
  [[gnu::always_inline]] Lanes(const Half& a, const Half& b) : first(a), second(b) {}

  [[gnu::always_inline]] friend Lanes operator+(const Lanes& a, const Lanes& b) {
    return {a.first + b.first, a.second + b.second};
  }
  [[gnu::always_inline]] friend Lanes operator-(const Lanes& a, const Lanes& b) {
    return {a.first - b.first, a.second - b.second};
  }
  [[gnu::always_inline]] friend Lanes operator*(const Lanes& a, const Lanes& b) {
    return {a.first * b.first, a.second * b.second};
  }
  [[gnu::always_inline]] friend Lanes operator/(const Lanes& a, const Lanes& b) {
    return {a.first / b.first, a.second / b.second};
  }
  [[gnu::always_inline]] friend Lanes operator-(const Lanes& a) { return {-a.first, -a.second}; }
  [[gnu::always_inline]] Lanes& operator+=(const Lanes& b) { return *this = *this + b; }
  [[gnu::always_inline]] friend Mask operator<(const Lanes& a, const Lanes& b) {
    return {a.first < b.first, a.second < b.second};
  }
  [[gnu::always_inline]] friend Mask operator<=(const Lanes& a, const Lanes& b) {
    return {a.first <= b.first, a.second <= b.second};
  }
  [[gnu::always_inline]] friend Mask operator>(const Lanes& a, const Lanes& b) { return b < a; }
  [[gnu::always_inline]] friend Mask operator>=(const Lanes& a, const Lanes& b) { return b <= a; }
  [[gnu::always_inline]] friend Mask operator!=(const Lanes& a, const Lanes& b) {
    return {a.first != b.first, a.second != b.second};
  }

  [[gnu::always_inline]] friend Lanes abs(const Lanes& a) { return {abs(a.first), abs(a.second)}; }
  [[gnu::always_inline]] friend Lanes sqrt(const Lanes& a) { return {sqrt(a.first), sqrt(a.second)}; }
  [[gnu::always_inline]] friend Lanes power_of_two(const Lanes& a) {
    return {power_of_two(a.first), power_of_two(a.second)};
  }
  [[gnu::always_inline]] friend Lanes select(const Mask& which, const Lanes& yes, const Lanes& no) {
    return {select(which.first, yes.first, no.first), select(which.second, yes.second, no.second)};
  }
};

template <class Width>
[[gnu::always_inline]] inline unsigned set_bits(const LaneMask<Twice<Width>>& mask) {
  return set_bits(mask.first) | set_bits(mask.second) << Width::lanes;
}
template <class Width>
[[gnu::always_inline]] inline bool all(const LaneMask<Twice<Width>>& mask) {
  return all(mask.first & mask.second);
}
template <class Width>
[[gnu::always_inline]] inline bool any(const LaneMask<Twice<Width>>& mask) {
  return any(mask.first | mask.second);
}

}  // namespace wormdrive
