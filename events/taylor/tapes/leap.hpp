#pragma once
#include "events/taylor/tapes/argument.hpp"
#include "events/taylor/tapes/series.hpp"
#include "events/taylor/terms.hpp"

namespace wormdrive {

/// One step of a drive whose equations are on a tape, without a search for events: of one drive or of several at once.
template <class V>
class TapedLeapOf {
 public:
  using Mask = MaskOf<V>;
  using In = TapeInput;

  static constexpr int longest = highest_order;  ///< coefficients that a step may take

  explicit TapedLeapOf(const TapeSeriesOf<V>& series) : series_(series) {}

  /// Takes up a moment [s, rad, rad/s] with what the motor is told and what disturbs the worm's shaft [N m], and works
  /// out all that they come to. Further coefficients of the command are in their place.
  template <class Functions>
  [[gnu::always_inline]] void begin(const V& t, const V& theta, const V& omega, const V& motor, const V& disturbs,
                                    Functions&& functions) {
    series_[In::time][0] = t;
    series_[In::time][1] = 1.0;
    series_[In::angle][0] = theta;
    series_[In::speed][0] = omega;
    series_[In::command][0] = motor;
    series_[In::disturbance][0] = disturbs;
    const TapedMotionOf<V>& m = series_.motion();
    series_[In::brake][0] = m.brake;
    V torque = m.load + m.slope * (t - m.start);
    for (int k = 0; k < series_.code().waves; ++k) {
      WaveOf<V>& wave = series_.wave(k);
      wave.now = functions.sine_and_cosine(wave.omega * t + wave.phase);
      torque += wave.amplitude * wave.now.cosine;
    }
    series_[In::load][0] = torque;
    series_.work_out(0, series_.code().operations, functions);
    if (series_.code().sections == 0) return;
    expand_load(1, 1);
    expand_motion(0);
    series_.work_out(1, series_.code().of_acceleration, functions);  // of the arguments of tables
  }

  /// Whether the mode certainly goes on under new torques: they are clear of the switching surface, as
  /// WormDrive::flank_by_far() has it.
  [[gnu::always_inline]] Mask goes_on() const {
    const TapedMotionOf<V>& m = series_.motion();
    const Mask without_teeth = !(m.flank != V(0.0));
    return (without_teeth & moves()) | clear_of_surface(-m.flank);
  }
  /// Whether the other flank certainly carries under them.
  [[gnu::always_inline]] Mask changes_flank() const { return clear_of_surface(series_.motion().flank); }

  /// Works out coefficient k + 1 of angle, speed and states.
  [[gnu::always_inline]] void expand_motion(int k) {
    const TapeCode& code = series_.code();
    const V share = one_over(k + 1);
    series_[In::angle][k + 1] = series_[In::speed][k] * share;
    series_[In::speed][k + 1] = series_[code.acceleration][k] * share;
    for (int j = 0; j < code.states; ++j) series_[In::first_state + j][k + 1] = series_[code.rates[j]][k] * share;
  }
  /// Lets the series have so many terms.
  [[gnu::always_inline]] void end_series(const TermsOf<V>& terms) {
    terms_ = terms;
    const TapeCode& code = series_.code();
    V *const theta = series_[In::angle], *const omega = series_[In::speed];
    theta[terms_.most + 1] = omega[terms_.most] * one_over(terms_.most + 1);
    if constexpr (!std::is_same_v<V, double>)
      for (int k = terms_.fewest + 1; k <= terms_.most; ++k) {  // a drive alone would have stopped there
        const Mask counts = V(static_cast<double>(k)) <= terms_.of_each;
        const auto cut = [&](V& c) { c = select(counts, c, V(0.0)); };
        cut(omega[k]);
        cut(theta[k + 1]);
        for (int j = 0; j < code.states; ++j) cut(series_[In::first_state + j][k]);
      }
  }
  /// Lets a leap end behind the first point of a table that is met within its length [s], and returns where, among
  /// these, it is certain which that is. Behind a point the cubic before it differs from the next one by the square of
  /// the way beyond, which is so short that rounding sees nothing of it, and so long that the next section holds there.
  [[gnu::always_inline]] Mask end_with_sections(const Mask& among, V& length) const {
    Mask certain = among;
    for (int k = 0; k < series_.code().sections; ++k) {
      const SectionOf<V>& section = series_.section(k);
      const ArgumentOf<V, longest> x(series_[series_.code().arguments[k]], terms_, length);
      const V now = x.terms[0], first = x.terms[1], sides = abs(first) + x.bends;
      const Mask stays = (now + sides < section.high) & (now - sides > section.low);
      certain = certain & (stays | (2.0 * x.turns <= abs(first)));
      const V end = select(first > V(0.0), section.high, section.low),
              way = 0x1p-20 * abs(x.moves) + 0x1p-50 * abs(end);
      const V target = select(first > V(0.0), end + way, end - way) - now;
      const Mask leaves = certain & !stays & (abs(x.moves) > abs(target));
      if (!any(leaves)) continue;
      V share = target / first;
      for (int n = 0; n < 6; ++n) share = within_limits<V>(share - x.beyond(target, share), V(0.0), V(1.0));
      certain = certain & ((!leaves) | (abs(x.beyond(target, share) * first) < 0.5 * way));
      length = select(leaves, share * length, length);
    }
    return certain;
  }
  /// How long a step may be that shall end with the section of a table that ends first, if arguments went on at the
  /// rate that they have: a longer one would take terms that nobody asks for.
  [[gnu::always_inline]] V longest_within_sections() const {
    V length = std::numeric_limits<double>::infinity();
    for (int k = 0; k < series_.code().sections; ++k) {
      const SectionOf<V>& section = series_.section(k);
      const V* const x = series_[series_.code().arguments[k]];
      const V left = select(x[1] > V(0.0), section.high - x[0], x[0] - section.low);
      length = least<V>(length, 1.25 * left / abs(x[1]));
    }
    return length;
  }
  /// Angle and speed so many seconds after the latest moment.
  V angle_after(const V& s) const { return value(series_[In::angle], terms_.most + 2, s); }
  V speed_after(const V& s) const { return value(series_[In::speed], terms_.most + 1, s); }
  V state_after(int state, const V& s) const { return value(series_[In::first_state + state], terms_.most + 1, s); }

  TapeSeriesOf<V>& series() { return series_; }
  const TapeSeriesOf<V>& series() const { return series_; }

  /// Coefficients of the load over time, from one behind the value up to another.
  void expand_load(int first, int last) {
    V* const c = series_[In::load];
    if (series_.code().waves == 0) last = 1;  // those behind it are zero for good
    for (int k = first; k <= last; ++k) c[k] = k == 1 ? series_.motion().slope : V(0.0);
    for (int n = 0; n < series_.code().waves; ++n) {
      const WaveOf<V>& wave = series_.wave(n);
      const V cosine = wave.amplitude * wave.now.cosine, sine = wave.amplitude * wave.now.sine;
      V weight = 1.0;  // omega^k / k!
      for (int k = 1; k <= last; ++k) {
        weight = weight * (wave.omega * one_over(k));
        if (k >= first) c[k] += weight * (k % 4 == 0 ? cosine : k % 4 == 1 ? -sine : k % 4 == 2 ? -cosine : sine);
      }
    }
  }

 private:
  const V& first(int place) const { return series_[place][0]; }
  [[gnu::always_inline]] Mask moves() const { return series_.motion().motion * first(In::speed) > V(0.0); }
  /// Whether a moving drive is clear of the switching surface on a side of it.
  [[gnu::always_inline]] Mask clear_of_surface(const V& side) const {
    const V most = abs(first(series_.code().worm)) + abs(series_.motion().surface * first(series_.code().gear));
    return moves() & (side * first(series_.code().beyond) > 2e-3 * most);
  }
  [[gnu::always_inline]] static V value(const V* c, int size, const V& s) {
    if constexpr (std::is_same_v<V, double>) {
      return wormdrive::value({c, static_cast<std::size_t>(size)}, s);
    } else {
      const V square = s * s;  // as a drive alone has it, even and odd powers side by side
      V even = 0.0, odd = 0.0;
      if (size % 2 == 1) even = c[--size];
      for (; size > 0; size -= 2) {
        even = even * square + c[size - 2];
        odd = odd * square + c[size - 1];
      }
      return even + s * odd;
    }
  }

  TapeSeriesOf<V> series_;
  TermsOf<V> terms_{};  ///< of the latest leap
};

}  // namespace wormdrive
