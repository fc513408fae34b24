#pragma once
#include "control/lanes/angles.hpp"
#include "control/lanes/batch.hpp"
#include "core/numbers/exponential.hpp"
#include "events/taylor/tape_operations.hpp"
#include "events/taylor/taped_leap.hpp"

// Included by one file for each instruction set, as kernel.hpp is.

namespace wormdrive {

/// The step of trials of one register whose equations are on tapes.
template <class Width>
class TapedPlant {
 public:
  using V = Lanes<Width>;
  using Mask = LaneMask<Width>;

  TapedPlant(const LaneBatch& batch, int r)
      : batch_(batch),
        r_(r),
        leap_(TapeSeriesOf<V>(*batch.tapes.code, batch.tapes.memory + static_cast<std::size_t>(r) * batch.tapes.room,
                              TapedLeapOf<V>::stride)) {}

  /// Moves angle and speed on to the next sample where that is certain beforehand, and returns where it is.
  [[gnu::always_inline]] Mask step(const LaneSample& sample, V& theta, V& omega, const V& torque,
                                   const V& disturbance) {
    const TapedMotionOf<V>& motion = leap_.series().motion();
    const Mask moves = motion.motion != V(0.0), ahead = V(sample.t + 2.0 * sample.step) < motion.next_knot;
    active_ = set_bits(moves & ahead) & batch_.alive[r_];
    leap_.begin(sample.t, theta, omega, torque, disturbance, *this);
    Mask known = ahead & leap_.goes_on() & leap_.series().is_within_sections();
    known = leap_.foresee(known, sample.step, batch_.accuracy, [](const V&) { return V(0.0); });
    if (!any(known)) return known;
    leap_.follow(*this);
    theta = select(known, leap_.angle_after(sample.step), theta);
    omega = select(known, leap_.speed_after(sample.step), omega);
    return known;
  }

  // ---- what the operations on a tape ask for -------------------------------------------------------------------

  [[gnu::always_inline]] SineAndCosineOf<V> sine_and_cosine(const V& x) const {
    return wormdrive::sine_and_cosine<Width>(x, active_, batch_.sine_and_cosine);
  }
  [[gnu::noinline]] V exp(const V& x) const {
    const V found = exponential(x);
    unsigned lanes = set_bits(!((x > V(-707.0)) & (x < V(709.0)))) & active_;
    if (lanes == 0) [[likely]]
      return found;
    EachLane<Width> each(found), arguments(x);
    for (; lanes != 0; lanes &= lanes - 1) {
      const int lane = __builtin_ctz(lanes);
      each.of[lane] = batch_.tapes.exp(arguments.of[lane]);
    }
    return lanes_from<Width>(each.of);
  }
  [[gnu::always_inline]] void find(int table, const V& x) {
    const SectionOf<V>& s = leap_.series().section(table);
    if (const unsigned outside = set_bits(!((s.low <= x) & (x < s.high))) & active_) [[unlikely]]
      find_each(table, x, outside);
  }
  /// Where a section ends the trial goes on alone.
  static constexpr bool turns(int, const V*, int) { return false; }

 private:
  [[gnu::noinline]] void find_each(int table, const V& x, unsigned lanes) {
    const EachLane<Width> each(x);
    auto* const fields = reinterpret_cast<double*>(&leap_.series().section(table));
    for (; lanes != 0; lanes &= lanes - 1) {
      const int lane = __builtin_ctz(lanes);
      put_into_lane(batch_.tapes.section(batch_.owner, r_ * Width::lanes + lane, table, each.of[lane]), fields + lane,
                    Width::lanes);
    }
  }

  const LaneBatch& batch_;
  int r_;
  TapedLeapOf<V> leap_;
  unsigned active_ = 0;  ///< a bit for every lane that does not wait for somebody else
};

}  // namespace wormdrive
