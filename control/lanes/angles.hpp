#pragma once
#include <cstring>

#include "core/numbers/lanes.hpp"
#include "core/numbers/sine_cosine.hpp"

// For kernels only, which are compiled for instruction sets of their own.

namespace wormdrive {

/// Trials of a register alone, in memory.
template <class Width>
struct EachLane {
  alignas(64) double of[Width::lanes];
  explicit EachLane(const Lanes<Width>& v) { __builtin_memcpy(of, &v, sizeof of); }
};

/// The numbers of a register as they stand in memory.
template <class Width>
[[gnu::always_inline]] inline Lanes<Width> lanes_from(const double* memory) {
  Lanes<Width> v;
  __builtin_memcpy(&v, memory, sizeof v);
  return v;
}

/// Sine and cosine of any angle, as a trial alone has them.
using SineAndCosineAlone = SineAndCosine (*)(double angle);

/// Those of angles that have to be turned back by quarter turns, as quarter_turn::turned() finds them; where that takes
/// what lanes do not do, one lane after the other.
template <class Width>
[[gnu::noinline]] SineAndCosineOf<Lanes<Width>> far_sine_and_cosine(const Lanes<Width>& x, unsigned alive,
                                                                    SineAndCosineAlone alone) {
  using V = Lanes<Width>;
  using namespace quarter_turn;
  const V k = (x * two_over_pi + to_whole) - to_whole, first = x - k * p1, second = k * p2_and_rest;
  const V high = first - second, low = (first - high) - second;
  const BothLanes<V> unturned = within(high, low);
  // what k leaves after whole turns: 0, +-1 or +-2 quarters
  const V quarters = k - 4.0 * ((k * 0.25 + to_whole) - to_whole), size = abs(quarters);
  const LaneMask<Width> odd = (size > V(0.5)) & (size < V(1.5));
  const V same = select(odd, V(0.0), 1.0 - size), other = select(odd, quarters, V(0.0));
  SineAndCosineOf<V> all{same * unturned[0] + other * unturned[1], same * unturned[1] + (-other) * unturned[0]};

  const auto near = abs(x) < V(furthest), known = (abs(x) < V(1e6)) & (abs(high) >= V(0x1p-10));
  if (unsigned lanes = set_bits(!(near | known)) & alive) [[unlikely]] {
    EachLane<Width> angles(x), sine(all.sine), cosine(all.cosine);
    for (; lanes != 0; lanes &= lanes - 1) {
      const int lane = __builtin_ctz(lanes);
      const SineAndCosine found = alone(angles.of[lane]);
      sine.of[lane] = found.sine;
      cosine.of[lane] = found.cosine;
    }
    all = {lanes_from<Width>(sine.of), lanes_from<Width>(cosine.of)};
  }
  if (!any(near)) return all;
  const BothLanes<V> within_reach = within(x);
  return {select(near, within_reach[0], all.sine), select(near, within_reach[1], all.cosine)};
}

/// Sine and cosine of the angles of a register, those of the lanes that are alive to the bits that they would have
/// alone.
template <class Width>
[[gnu::always_inline]] inline SineAndCosineOf<Lanes<Width>> sine_and_cosine(const Lanes<Width>& angle, unsigned alive,
                                                                            SineAndCosineAlone alone) {
  using V = Lanes<Width>;
  const unsigned distant = set_bits(!(abs(angle) < V(quarter_turn::furthest))) & alive;
  if (distant != 0U) [[unlikely]]
    return far_sine_and_cosine<Width>(angle, alive, alone);
  const Both<V> found = quarter_turn::within(angle);
  return {found[0], found[1]};
}

}  // namespace wormdrive
