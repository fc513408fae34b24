#pragma once
#include "events/taylor/accuracy.hpp"
#include "events/taylor/tapes/argument.hpp"
#include "events/taylor/tapes/reach.hpp"
#include "events/taylor/tapes/series.hpp"
#include "events/taylor/terms.hpp"

namespace wormdrive {

/// One step of a drive whose equations are on a tape, without a search for events: of one drive or of several at once.
template <class V>
class TapedLeapOf {
 public:
  using Mask = MaskOf<V>;
  using In = TapeInput;

  static constexpr int longest = 20;  ///< coefficients of the acceleration ...
  /// ... and where they are judged by their terms: a state that follows fast takes fewer of them in long steps.
  static constexpr int longest_by_terms = highest_order;
  /// Coefficients of the angle.
  static int stride(const TapeCode& code) { return 2 + (code.by_terms ? longest_by_terms : longest); }
  static constexpr double farthest = 64.0;  ///< leaps that the disc of times is wide
  /// Of the way to the edge of the disc, where a leap ends that would get further than half of it.
  static constexpr double within_reach = 0.25;
  /// The part of what was asked for that is worth a leap.
  static constexpr double worth_while = 0.125;

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
    expand_load(1);
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

  /// Where, among these, it is certain beforehand that no guard falls through zero within h [s] and how far the series
  /// must go, if the tables stay in their sections. h becomes shorter where that is not so for all of it, if that is at
  /// least a part of it. reach: of the motor's torque; command_disc: that in which it stays within one of times.
  ///
  /// Around the present moment there is a disc of complex times in which angle and speed stay in discs of theirs, and
  /// so nothing strays from its value f by more than some r. What is so bounded in a disc of a radius R differs from f
  /// by at most r |s|/R at a time s (Schwarz), and its k-th coefficient is at most r/R^k (Cauchy).
  template <class CommandDisc>
  [[gnu::always_inline]] Mask foresee(const Mask& among, V& h, double part, const TaylorAccuracy& accuracy,
                                      const CommandReach<V>& reach, CommandDisc&& command_disc) {
    const TapeCode& code = series_.code();
    const TapedMotionOf<V>& m = series_.motion();
    const V v = abs(first(In::speed)), alpha = first(code.acceleration);
    h = least<V>(least<V>(h, reach.leap), longest_within_sections());
    const V T = least<V>(reach.leaps_in_disc * h, least<V>(m.time_disc, reach.disc)), turn = m.angle_disc;
    // A disc of the speed with which that of the angle is used up at about the same time.
    const V change =
        greatest<V>(0.5 * (root(v * v + 4.0 * turn * abs(alpha)) - v), turn * (1.0 / (4.0 * farthest * h)));
    const V factor = look(among, T, turn, change, command_disc);
    Mask certain = factor >= V(1.0);
    if (!all(certain | (!among))) {
      // What bounds one of them need not bound the others: time as far as the others reach in proportion, and at least
      // as far as the leap needs; else all in proportion.
      const V smaller = (1.0 - 1e-6) * factor, less = smaller * change, reached = less / abs(alpha);
      const V near = least<V>(reached, greatest<V>(8.0 * h, smaller * turn / (v + less)));
      certain = look(among & (!certain), least<V>(near, T),
                     least<V>(turn, greatest<V>(smaller * turn, near * (v + less))), less, command_disc) >= V(1.0);
      if (!all(certain | (!among)))
        certain = look(among & (!certain), smaller * T, smaller * turn, less, command_disc) >= V(1.0);
    }
    const V disc = disc_of_times();
    V ratio = above_one * h / disc;
    certain = certain & among & (part * ratio <= V(within_reach));
    if (!any(certain)) return certain;
    const auto shorten = [&](const Mask& which) {
      if (!any(which)) return false;
      h = select(which, disc * (within_reach / above_one), h);
      ratio = select(which, V(within_reach), ratio);
      return true;
    };
    shorten(certain & (ratio > V(0.5)));
    V gain = count_terms(certain, h, ratio, accuracy);
    if (shorten(certain & (!terms_.suffice) & (ratio > V(within_reach)))) [[unlikely]]
      gain = count_terms(certain, h, ratio, accuracy);
    const Mask kept = terms_.suffice & keeps_mode(h, ratio), open = terms_.suffice & (!kept);
    if (!any(open)) return kept;
    // A disc hardly wider than the leap tells more of it.
    const V near = 1.25 * h, less = 1.25 * gain;
    const Mask fits = look(open, least<V>(near, T), near * (v + less), less, command_disc) >= V(1.0);
    ratio = above_one * h / disc_of_times();
    return kept | (open & fits & (ratio <= V(1.0)) & keeps_mode(h, ratio));
  }

  /// Works out the motion from there, which value() tells.
  template <class Functions>
  [[gnu::always_inline]] void follow(Functions&& functions) {
    expand_load();
    const int known = series_.code().sections > 0 ? 1 : 0;
    for (int k = 0; k < terms_.most; ++k) {
      if (k > known) series_.work_out(k, series_.code().of_acceleration, functions);
      expand_motion(k);
    }
    end_series(terms_);
  }
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
      const ArgumentOf<V, longest_by_terms> x(series_[series_.code().arguments[k]], terms_, length);
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

  /// Coefficients of the load over time from the second on, up to the order that is asked for.
  void expand_load(int order) {
    const TapedMotionOf<V>& m = series_.motion();
    V* const c = series_[In::load];
    for (int k = 1; k <= order; ++k) c[k] = k == 1 ? m.slope : V(0.0);
    for (int n = 0; n < series_.code().waves; ++n) {
      const WaveOf<V>& wave = series_.wave(n);
      const V cosine = wave.amplitude * wave.now.cosine, sine = wave.amplitude * wave.now.sine;
      V weight = 1.0;  // omega^k / k!
      for (int k = 1; k <= order; ++k) {
        weight = weight * (wave.omega * one_over(k));
        c[k] += weight * (k % 4 == 0 ? cosine : k % 4 == 1 ? -sine : k % 4 == 2 ? -cosine : sine);
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
  /// The disc of times in which angle and speed stay in theirs.
  [[gnu::always_inline]] V disc_of_times() const {
    const V strays = series_.radius(series_.code().acceleration), alpha = abs(first(series_.code().acceleration));
    return least<V>(least<V>(series_.radius(In::speed) / (above_one * (alpha + strays)),
                             series_.radius(In::angle) / (abs(first(In::speed)) + series_.radius(In::speed))),
                    series_.radius(In::time));
  }
  /// Finds how many terms a leap of h [s] takes, so large a share of the way to the edge of the disc, and returns by
  /// how much it may change the speed.
  [[gnu::always_inline]] V count_terms(const Mask& among, const V& h, const V& ratio, const TaylorAccuracy& accuracy) {
    const V bend = series_.radius(series_.code().acceleration) * ratio;
    const V gain = above_one * (abs(first(series_.code().acceleration)) + bend) * h;
    const V allowed = accuracy.allowed(abs(first(In::speed)) + gain, h) * (1.0 - ratio);
    // of the arguments of tables it has to be known how they bend
    terms_ = series_.code().sections > 0 ? TermsOf<V>::needed(among, 3, longest, bend * ratio * ratio, ratio, allowed)
                                         : TermsOf<V>::needed(among, 1, longest, bend, ratio, allowed);
    return gain;
  }
  /// Where no guard falls through zero and nothing leaves its range in a leap of h [s], so large a share of the way to
  /// the edge of the disc.
  [[gnu::always_inline]] Mask keeps_mode(const V& h, const V& ratio) const {
    const TapeCode& code = series_.code();
    const TapedMotionOf<V>& m = series_.motion();
    const V alpha = first(code.acceleration), along = m.motion * first(In::speed);
    const V bend = series_.radius(code.acceleration) * ratio;
    const Mask turns =
        !((along > above_one * (abs(alpha) + bend) * h) | ((along >= V(0.0)) & (m.motion * alpha > bend)));
    const Mask without_teeth = !(m.flank != V(0.0));
    return (!turns) & (without_teeth | (-m.flank * first(code.beyond) > series_.radius(code.beyond) * ratio)) &
           series_.stays_in_range(ratio);
  }
  /// Works out discs with others of time, angle and speed in some lanes, and returns by how much all are too large.
  template <class CommandDisc>
  V look(const Mask& which, const V& time, const V& angle, const V& speed, CommandDisc&& command_disc) {
    const auto put = [&](int input, const V& radius) {
      series_.radius(input) = select(which, radius, series_.radius(input));
    };
    put(In::time, time);
    put(In::angle, angle);
    put(In::speed, speed);
    put(In::command, command_disc(time));
    put(In::load, load_disc(time));
    series_.radius(In::disturbance) = series_.radius(In::brake) = 0.0;
    series_.work_out_discs();
    return series_.shrinking();
  }
  void expand_load() { expand_load(terms_.most - 1); }

  /// The most by which the load over time differs from its value within so many seconds, complex ones too: a cosine by
  /// amplitude (e^x - 1), x = omega seconds, which is at most as steep as where x is greatest, and there is at most 1.
  V load_disc(const V& seconds) const {
    const TapedMotionOf<V>& m = series_.motion();
    const V x = m.fastest * seconds;
    const V growth = 1.0 + x * (1.0 / 2) * (1.0 + x * (1.0 / 3) * (1.0 + x * (1.0 / 4) * (1.0 + x * (1.3 / 5))));
    return select(seconds > V(0.0), seconds * (abs(m.slope) + m.steepness * growth), V(0.0));
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
