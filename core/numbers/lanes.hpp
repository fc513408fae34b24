#pragma once
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "core/numbers/pair.hpp"

namespace wormdrive {

/// Which of several lanes something holds for.
template <class Width>
struct LaneMask {
  using Bits = typename Width::Bits;
  Bits bits;

  [[gnu::always_inline]] friend LaneMask operator&(const LaneMask& a, const LaneMask& b) { return {a.bits & b.bits}; }
  [[gnu::always_inline]] friend LaneMask operator|(const LaneMask& a, const LaneMask& b) { return {a.bits | b.bits}; }
  [[gnu::always_inline]] friend LaneMask operator!(const LaneMask& a) { return {~a.bits}; }
};

/// The same number of several trials side by side in one register; each is rounded as a double alone. Width says how
/// many: `lanes`, the types `Register` of doubles and `Bits` of 64-bit integers, `signs(Bits)`, their upper bits, and
/// `roots(Register)`.
template <class Width>
struct Lanes {
  using Register = typename Width::Register;
  using Mask = LaneMask<Width>;
  Register x;

  Lanes() = default;
  [[gnu::always_inline]] Lanes(double all) : x(all - Register{}) {}
  [[gnu::always_inline]] explicit Lanes(Register each) : x(each) {}

  [[gnu::always_inline]] friend Lanes operator+(const Lanes& a, const Lanes& b) { return Lanes(a.x + b.x); }
  [[gnu::always_inline]] friend Lanes operator-(const Lanes& a, const Lanes& b) { return Lanes(a.x - b.x); }
  [[gnu::always_inline]] friend Lanes operator*(const Lanes& a, const Lanes& b) { return Lanes(a.x * b.x); }
  [[gnu::always_inline]] friend Lanes operator/(const Lanes& a, const Lanes& b) { return Lanes(a.x / b.x); }
  [[gnu::always_inline]] friend Lanes operator-(const Lanes& a) { return Lanes(-a.x); }
  [[gnu::always_inline]] Lanes& operator+=(const Lanes& b) { return x += b.x, *this; }
  [[gnu::always_inline]] friend Mask operator<(const Lanes& a, const Lanes& b) { return {a.x < b.x}; }
  [[gnu::always_inline]] friend Mask operator<=(const Lanes& a, const Lanes& b) { return {a.x <= b.x}; }
  [[gnu::always_inline]] friend Mask operator>(const Lanes& a, const Lanes& b) { return {a.x > b.x}; }
  [[gnu::always_inline]] friend Mask operator>=(const Lanes& a, const Lanes& b) { return {a.x >= b.x}; }
  [[gnu::always_inline]] friend Mask operator!=(const Lanes& a, const Lanes& b) { return {a.x != b.x}; }

  [[gnu::always_inline]] friend Lanes abs(const Lanes& a) {
    using Bits = typename Width::Bits;
    return Lanes(reinterpret_cast<Register>(reinterpret_cast<Bits>(a.x) & 0x7fff'ffff'ffff'ffff));
  }
  [[gnu::always_inline]] friend Lanes sqrt(const Lanes& a) { return Lanes(Width::roots(a.x)); }
  /// 2^k of the whole numbers k in their last bits.
  [[gnu::always_inline]] friend Lanes power_of_two(const Lanes& a) {
    using Bits = typename Width::Bits;
    return Lanes(reinterpret_cast<Register>((reinterpret_cast<Bits>(a.x) + 1023) << 52));
  }
  [[gnu::always_inline]] friend Lanes select(const Mask& which, const Lanes& yes, const Lanes& no) {
    return Lanes(which.bits ? yes.x : no.x);
  }
};

/// A bit for every lane, the first the lowest.
template <class Width>
[[gnu::always_inline]] inline unsigned set_bits(const LaneMask<Width>& mask) {
  return Width::signs(mask.bits);
}
template <class Width>
[[gnu::always_inline]] inline bool all(const LaneMask<Width>& mask) {
  return Width::signs(mask.bits) == (1U << Width::lanes) - 1U;
}

template <class Width>
[[gnu::always_inline]] inline bool any(const LaneMask<Width>& mask) {
  return Width::signs(mask.bits) != 0U;
}

// The same for a trial alone.
[[gnu::always_inline]] inline bool all(bool mask) { return mask; }
[[gnu::always_inline]] inline bool any(bool mask) { return mask; }
[[gnu::always_inline]] inline double abs(double x) { return std::fabs(x); }
template <class V>
[[gnu::always_inline]] inline V root(const V& x) {
  using std::sqrt;
  return sqrt(x);
}
[[gnu::always_inline]] inline double select(bool which, double yes, double no) { return which ? yes : no; }
/// True or false for a trial alone, a mask for several.
template <class V>
using MaskOf = decltype(V() < V());

/// The same for what mostly stays as it was: a processor foretells the branch and need not wait for the condition.
template <class V>
[[gnu::always_inline]] inline V select_steady(const MaskOf<V>& which, const V& yes, const V& no) {
  if constexpr (std::is_same_v<V, double>) {
    if (__builtin_expect_with_probability(which, true, 0.999)) return yes;
    return no;
  } else {
    return select(which, yes, no);
  }
}

/// std::min, std::max and std::clamp for either, with the same choice between equals and where one is no number.
template <class V>
[[gnu::always_inline]] inline V least(const V& a, const V& b) {
  return select(b < a, b, a);
}
template <class V>
[[gnu::always_inline]] inline V greatest(const V& a, const V& b) {
  return select(a < b, b, a);
}
template <class V>
[[gnu::always_inline]] inline V within_limits(const V& x, const V& low, const V& high) {
  return select(x < low, low, select(high < x, high, x));
}

/// Exchanges so many numbers with others in some lanes.
template <class V>
[[gnu::always_inline]] inline void swap_where(const MaskOf<V>& which, V* a, V* b, std::size_t count) {
  for (std::size_t k = 0; k < count; ++k) {
    const V mine = a[k];
    a[k] = select(which, b[k], mine);
    b[k] = select(which, mine, b[k]);
  }
}

/// Two numbers that go through the same formulas; a Pair where they are those of one trial.
template <class V>
struct BothLanes {
  V first, second;

  [[gnu::always_inline]] const V& operator[](int k) const { return k == 0 ? first : second; }
  [[gnu::always_inline]] friend BothLanes operator+(const BothLanes& a, const BothLanes& b) {
    return {a.first + b.first, a.second + b.second};
  }
  [[gnu::always_inline]] friend BothLanes operator-(const BothLanes& a, const BothLanes& b) {
    return {a.first - b.first, a.second - b.second};
  }
  [[gnu::always_inline]] friend BothLanes operator*(const BothLanes& a, const BothLanes& b) {
    return {a.first * b.first, a.second * b.second};
  }
  [[gnu::always_inline]] friend BothLanes operator*(const V& a, const BothLanes& b) {
    return {a * b.first, a * b.second};
  }
  [[gnu::always_inline]] friend BothLanes operator-(const V& a, const BothLanes& b) {
    return {a - b.first, a - b.second};
  }
  [[gnu::always_inline]] BothLanes& operator+=(const BothLanes& b) { return *this = *this + b; }
  [[gnu::always_inline]] friend BothLanes abs(const BothLanes& a) { return {abs(a.first), abs(a.second)}; }
};

namespace lanes {
template <class V>
struct Both {
  using Type = BothLanes<V>;
};
template <>
struct Both<double> {
  using Type = Pair;
};
}  // namespace lanes
template <class V>
using Both = typename lanes::Both<V>::Type;

/// The same for all trials.
template <class V>
[[gnu::always_inline]] inline Both<V> both(Pair of_all) {
  return Both<V>{V(of_all[0]), V(of_all[1])};
}

/// Puts a struct of doubles into its lane among others: field k of all of a register, then field k + 1. first: its own.
template <class Fields>
[[gnu::always_inline]] inline void put_into_lane(const Fields& fields, double* first, std::size_t lanes) {
  static_assert(std::is_trivially_copyable_v<Fields>);
  double list[sizeof fields / sizeof(double)];
  __builtin_memcpy(list, &fields, sizeof fields);
  for (std::size_t k = 0; k < sizeof fields / sizeof(double); ++k) first[k * lanes] = list[k];
}

/// Such a struct out of its lane.
template <class Fields>
Fields from_lane(const double* first, std::size_t lanes) {
  double list[sizeof(Fields) / sizeof(double)];
  for (std::size_t k = 0; k < sizeof list / sizeof(double); ++k) list[k] = first[k * lanes];
  Fields fields;
  __builtin_memcpy(&fields, list, sizeof fields);
  return fields;
}

}  // namespace wormdrive
